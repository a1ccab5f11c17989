// One polygon of an object-aligned stack with the textures of one, two or four slices (rezksalama2000, sections 4 to 6).
// Twin: slices2d_twin.cpp.

// Premultiplied colour and opacity of `len` world units of the slab around slice k.
vec4 shade_slice(float k, vec3 box, float len) {
  vec4 texel = sample_slice(k, box);
  if (VM_CLASSIFICATION == 1) return shade_classified(texel, len);
  return shade_segment(transfer((texel.r - vm.value.x) * vm.value.y), len, box);
}

void main() {
  PolygonRay ray = polygon_ray();
  Meeting meeting = before_slices(ray);
  colour = vec4(0.);
  for (int i = 0; i < VM_TEXTURES; ++i) {
    float k = ray.first + ray.toward * float(i);
    meeting = next_slice(ray, k, i, meeting);
    if (float(i) < ray.count && meeting.len > 0.) {
      vec4 slice = shade_slice(k, meeting.box, meeting.len);
      colour = slice + (1. - slice.a) * colour;  // their eq. 3 to 5
    }
  }
}
