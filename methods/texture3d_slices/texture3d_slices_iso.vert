// A corner of a slice: its place in the picture and in the volume, and the slice's place in the drawing order as depth.
layout(location = 0) in vec2 in_ndc;
layout(location = 1) in vec3 in_box;
layout(location = 2) in float in_depth;
layout(location = 0) out vec3 out_box;

void main() {
  gl_Position = vec4(in_ndc, in_depth, 1.);
  out_box = in_box;
}
