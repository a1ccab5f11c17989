VM_SPEC(0, kMode, 0)    // 0: first colour, 1: second colour, 2: discard odd columns
VM_SPEC(1, kScale, 1)
layout(std140, binding = 3) uniform Colours { vec4 first, second; };
layout(location = 0) in vec4 v_colour;
layout(location = 0) out vec4 out_colour;
void main() {
  if (kMode == 2 && (int(gl_FragCoord.x) & 1) == 1) discard;
  out_colour = (kMode == 1 ? second : first) * float(kScale);
}
