// The largest value along the pixel's ray, as grey. Twin: toy_mip_cpu.cpp.
layout(location = 0) in vec2 ndc;
layout(location = 0) out vec4 colour;

// vm.own[0].x: samples a ray.
void main() {
  colour = vec4(0.);
  vec3 origin = ray_origin(ndc), direction = ray_direction(ndc);
  float z0 = vm.depth.x, z1 = 1e30;
  clip_ray(origin, direction, z0, z1);
  if (!(z0 < z1)) return;
  float dz = (z1 - z0) / vm.own[0].x;
  float largest = 0.;
  for (float k = .5; k < vm.own[0].x; ++k) largest = max(largest, sample_value(origin + (z0 + k * dz) * direction));
  colour = vec4(vec3(min(largest, 1.)), 1.);
}
