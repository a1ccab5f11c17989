// One triangle over the whole target; NDC to the fragments.
layout(location = 0) out vec2 ndc;

void main() {
  ndc = vec2(VM_VERTEX == 1 ? 3. : -1., VM_VERTEX == 2 ? 3. : -1.);
  gl_Position = vec4(ndc, 0., 1.);
}
