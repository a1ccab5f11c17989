// One sample of one slice in the arithmetic of the boards of 2000. Nothing is interpolated across the polygon: it only
// covers the pixels, and may cover some beside the volume, which get nothing.
layout(location = 0) flat in float slice;
layout(location = 0) out vec4 colour;

void main() {
  float z = depth_of(floor(slice + .5), fx.depth.y);
  colour = vec4(sample_at(position_of(window_origin(), window_direction(), z))) / 255.;
}
