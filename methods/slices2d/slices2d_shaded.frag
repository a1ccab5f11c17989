// One slice of an object-aligned stack, lit (rezksalama2000, section 8). Twin: slices2d_shaded_twin.cpp. Their forms
// have the light of their eq. 6, ambient and diffuse; what diffuse light falls on is white.
VM_SPEC(9, VM_FORM, 0)      // 0: full; 1: gradient; 2: separate
VM_SPEC(10, VM_NORMALS, 0)  // 0: texels hold gradients, normalised here; 1: normals, which are not

layout(binding = 5) uniform sampler2D gradients;  // form separate: the page of gradients that belongs to that of colours

#ifndef VM_WITHOUT_LIGHTING
vec3 sample_gradients(float k, vec3 box) {
  vec2 at = place_in_slice(box);
  Stored stored = stored_around(k, box);
  vec3 below = textureLod(gradients, place_on_page(stored.below, at), 0.).rgb;
  if (VM_INTERPOLATE == 0) return below;
  return mix(below, textureLod(gradients, place_on_page(stored.above, at), 0.).rgb, stored.weight);
}

vec3 stored_normal(vec3 texel) {
  vec3 vector = texel * vm.texel.x + vm.texel.y;
  return VM_NORMALS == 1 ? vector : normal_of(vector);
}

// Gradient and value a texel; the transfer function is applied to interpolated values, and light is that of
// scenes/scene.h.
vec4 shade_full(float k, vec3 box, float len) {
  vec4 texel = sample_slice(k, box);
  vec4 point = transfer((texel.a - vm.value.x) * vm.value.y);
  float alpha = opacity_of(point.a * len);
  if (alpha <= 0.) return vec4(0.);
  vec3 diffuse = vec3(vm.lighting.x), specular = vec3(0.);
  add_lights(stored_normal(texel.rgb), box, diffuse, specular);
  return vec4((point.rgb * diffuse + specular) * alpha, alpha);
}

// Gradient and opacity a texel: no colour of the data, the ambient one is global.
vec4 shade_gradient(float k, vec3 box, float len) {
  vec4 texel = sample_slice(k, box);
  if (texel.a <= 0.) return vec4(0.);
  float alpha = correct_opacity(texel.a, len * vm.size.w);
  vec3 light = vec3(vm.lighting.x), none = vec3(0.);
  add_lights(stored_normal(texel.rgb), box, light, none);
  return vec4(light * alpha, alpha);
}

// Gradients in one texture, ambient colour and opacity in the other.
vec4 shade_separate(float k, vec3 box, float len) {
  vec4 slice = shade_classified(sample_slice(k, box), len);
  if (slice.a <= 0.) return vec4(0.);
  vec3 light = vec3(0.), none = vec3(0.);
  add_lights(stored_normal(sample_gradients(k, box)), box, light, none);
  return vec4(slice.rgb * vm.lighting.x + light * slice.a, slice.a);
}

vec4 shade_slice(float k, vec3 box, float len) {
  if (VM_FORM == 1) return shade_gradient(k, box, len);
  if (VM_FORM == 2) return shade_separate(k, box, len);
  return shade_full(k, box, len);
}
#endif

void main() {
  colour = vec4(0.);
#ifndef VM_WITHOUT_LIGHTING
  PolygonRay ray = polygon_ray();
  Meeting meeting = next_slice(ray, ray.first, 0, before_slices(ray));
  if (meeting.len > 0.) colour = shade_slice(ray.first, meeting.box, meeting.len);
#endif
}
