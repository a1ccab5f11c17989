// The isosurface (scenes/scene.h) along one ray a fragment: segments of one step from where the ray enters, the first of
// which holds the surface where either end lies in the solid; then a search inside of it. Behind walk.glsl. Twin:
// raycast_iso_cpu.cpp.
VM_SPEC(7, VM_REFINE, 0)  // 0: the segment's inner end; n: n - 1 bisections, then the line between both ends

layout(location = 0) in vec2 ndc;
layout(location = 0) out vec4 colour;

// Where the surface is met, in steps; negative: nowhere.
float first_hit(Walk walk) {
  float front = 0., back = 0., begin = 0., end = 0.;
  int known = -1;  // the segment that begins with value `back`
  for (int k = 0;; ++k) {
    if (VM_SKIP_EMPTY == 1) k = next_segment(walk, k);
    if (k >= walk.count) return -1.;
    begin = float(k);
    end = min(begin + 1., walk.steps);
    front = back;
    if (known != k) front = sample_value(position_of(walk, begin));
    back = sample_value(position_of(walk, end));
    known = k + 1;
    if (max(front, back) >= surface.colour.w) break;
  }
  if (front >= surface.colour.w) return begin;
  if (VM_REFINE == 0) return end;
  for (int i = 1; i < VM_REFINE; ++i) {
    float middle = .5 * (begin + end);
    float value = sample_value(position_of(walk, middle));
    if (value >= surface.colour.w) {
      end = middle;
      back = value;
    } else {
      begin = middle;
      front = value;
    }
  }
  return begin + meet_line(front, back) * (end - begin);
}

void main() {
  colour = vec4(0.);
  vec3 origin = ray_origin(ndc), direction = ray_direction(ndc);
  float z0 = vm.depth.x, z1 = 1e30;
  clip_ray(origin, direction, z0, z1);
  if (!(z0 < z1)) return;
  Walk walk = walk_of(origin, direction, z0, z1);
  float at = first_hit(walk);
  if (at < 0.) return;
  colour = vec4(surface.colour.rgb, 1.);
#ifndef VM_WITHOUT_LIGHTING
  if (VM_LIGHTS > 0) {
    vec3 hit = position_of(walk, at);
    colour = shade_surface(normal_of(sample_gradient(hit)), hit);
  }
#endif
}
