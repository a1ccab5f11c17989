// A corner of a slice: its place in the picture and in the volume, and the slice's place in the drawing order as depth.
layout(location = 0) in vec2 in_ndc;
layout(location = 1) in float in_plane;
layout(location = 2) in float in_depth;
layout(location = 0) flat out float out_plane;

void main() {
  gl_Position = vec4(in_ndc, in_depth, 1.);
  out_plane = in_plane;
}
