// A corner of a polygon: its place in the picture, the slab that it covers, and its place in the drawing order as depth.
layout(location = 0) in vec2 in_ndc;
layout(location = 1) in float in_slab;
layout(location = 2) in float in_depth;
layout(location = 0) out float out_slab;

void main() {
  gl_Position = vec4(in_ndc, in_depth, 1.);
  out_slab = in_slab;
}
