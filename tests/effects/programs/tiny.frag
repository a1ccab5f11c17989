// Of known size: load, multiply, store, return; one add more with VM_EXTRA, and a loop of VM_TURNS turns.
VM_SPEC(0, VM_EXTRA, 0)
VM_SPEC(1, VM_TURNS, 0)
layout(location = 0) in vec4 value;
layout(location = 0) out vec4 colour;

vec4 doubled(vec4 v) { return v * 2.; }

void main() {
  vec4 v = doubled(value);
  if (VM_EXTRA == 1) v += vec4(1., 2., 3., 4.);
  for (int i = 0; i < VM_TURNS; ++i) v = v * v;
  colour = v;
}
