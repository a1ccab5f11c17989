// One sample of one slice (Cabral 1994; westermann1998 section 2): the colour and opacity of the stretch of the pixel's
// ray inside the slab around the slice. With VM_CLIP_SLABS the stretch ends where the volume ends.
VM_SPEC(6, VM_CLIP_SLABS, 1)
layout(location = 0) flat in float plane;  // depth of the middle plane of the slab
layout(location = 0) out vec4 colour;

void main() {
  // The pixel's own ray, in window coordinates: what is interpolated across a thin polygon is noise.
  vec3 direction = ray_direction(gl_FragCoord.xy);
  vec3 box = ray_origin(gl_FragCoord.xy) + plane * direction;
  float z0 = -.5 * vm.depth.w, z1 = .5 * vm.depth.w;
  if (VM_CLIP_SLABS == 1) {
    clip_ray(box, direction, z0, z1);
    if (z1 <= z0) z0 = z1 = 0.;  // the ray misses this part of the volume: a segment of no length
  }
  float len = (z1 - z0) * ray_length(direction);
  vec3 middle = box + (.5 * (z0 + z1)) * direction;
  if (VM_CLASSIFICATION == 0) {
    colour = shade_segment(transfer(sample_value(middle)), len, middle);
  } else if (VM_CLASSIFICATION == 1) {
    colour = shade_classified(sample_classified(middle), len);
  } else {
    float front = sample_value(box + z0 * direction), back = sample_value(box + z1 * direction);
    colour = shade_preintegrated(transfer_segment(front, back), len, middle);
  }
}
