// A corner of a polygon: its place in the picture, and which slices the polygon carries. Textures are not placed here:
// the fragment program meets each slice with the pixel's own ray (slices2d.frag).
layout(location = 0) in vec2 in_ndc;
layout(location = 1) in vec2 in_group;
layout(location = 0) out vec2 out_group;

void main() {
  gl_Position = vec4(in_ndc, .5, 1.);
  out_group = in_group;
}
