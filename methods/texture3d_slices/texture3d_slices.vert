// A corner of a slice: its place in the picture and in the volume. Slices are perpendicular to the view, so that both are
// affine in the picture and no perspective division is needed.
layout(location = 0) in vec2 in_ndc;
layout(location = 1) in float in_plane;
layout(location = 0) flat out float out_plane;

void main() {
  gl_Position = vec4(in_ndc, .5, 1.);
  out_plane = in_plane;
}
