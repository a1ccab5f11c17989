// What tiny.frag is with both constants at 0, under other names and in another order.
layout(location = 0) out vec4 result;
layout(location = 0) in vec4 incoming;

void main() {
  vec4 unused = incoming + 7.;
  result = incoming * 2.;
}
