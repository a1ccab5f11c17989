// A corner of a slice: its place in the picture and the number of the slice.
layout(location = 0) in vec2 in_ndc;
layout(location = 1) in float in_slice;
layout(location = 0) flat out float out_slice;

void main() {
  gl_Position = vec4(in_ndc, .5, 1.);
  out_slice = in_slice;
}
