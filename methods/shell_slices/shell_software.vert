// A corner of a section that the host has computed (lensch2002, section 4).
layout(location = 0) in vec2 in_ndc;
layout(location = 1) in vec3 in_texture;
layout(location = 0) out vec3 out_texture;

void main() {
  gl_Position = vec4(in_ndc, .5, 1.);
  out_texture = in_texture;
}
