// A corner of a section that the host has computed (lensch2002, section 4).
layout(location = 0) in vec2 in_ndc;
layout(location = 1) in vec3 in_texture;
#ifdef VM_SHELL_LIT
layout(location = 2) in vec3 in_box;
layout(location = 3) in vec3 in_gradient_u;
layout(location = 4) in vec3 in_gradient_v;
layout(location = 5) in vec3 in_gradient_w;
#endif

void main() {
  gl_Position = vec4(in_ndc, .5, 1.);
  out_texture = in_texture;
#ifdef VM_SHELL_LIT
  out_box = in_box;
  out_gradient_u = in_gradient_u;
  out_gradient_v = in_gradient_v;
  out_gradient_w = in_gradient_w;
#endif
}
