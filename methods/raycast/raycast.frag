// One ray a fragment. The stretch of the ray inside the (clipped) volume is cut into segments of one step from where it
// enters; the last one ends where the ray leaves. Segment k begins at entry + k stride: never accumulated, so that
// skipping, which jumps over whole segments, leaves the others where they were. Behind walk.glsl. Twin: raycast_cpu.cpp.
layout(location = 0) in vec2 ndc;
layout(location = 0) out vec4 colour;

// vm.own[0].w: transmittance below which a ray ends.
// vm.own[2]: x < s_n < y holds for every value that is not transparent.

// The first segment from k on whose sample, at its middle, does not lie in transparent bricks.
int next_sample(Walk walk, int k) {
  while (k < walk.count) {
    float middle = float(k) + .5 * min(walk.steps - float(k), 1.);
    float until = empty_until(walk, walk.brick_entry + middle * walk.brick_stride);
    if (until < 0.) break;
    k = max(k + 1, int(ceil(min(until, float(walk.count) + 1.) - .5)));
  }
  return k;
}

vec4 march_samples(Walk walk) {
  vec4 sum = vec4(0.);
  for (int k = 0;; ++k) {
    if (VM_SKIP_EMPTY == 1) k = next_sample(walk, k);
    if (k >= walk.count) break;
    float part = min(walk.steps - float(k), 1.);
    vec3 box = position_of(walk, float(k) + .5 * part);
    sum += (1. - sum.a) * shade_segment(transfer(sample_value(box)), part * vm.depth.w, box);
    if (1. - sum.a < vm.own[0].w) break;
  }
  return sum;
}

vec4 march_segments(Walk walk) {
  vec4 sum = vec4(0.);
  float back = 0.;
  int known = -1;  // the segment that begins with value `back`
  for (int k = 0;; ++k) {
    if (VM_SKIP_EMPTY == 1) k = next_segment(walk, k);
    if (k >= walk.count) break;
    float part = min(walk.steps - float(k), 1.);
    float front = back;
    if (known != k) front = sample_value(position_of(walk, float(k)));
    back = sample_value(position_of(walk, float(k) + part));
    known = k + 1;
    vec3 middle = position_of(walk, float(k) + .5 * part);
    sum += (1. - sum.a) * shade_preintegrated(transfer_segment(front, back), part * vm.depth.w, middle);
    if (1. - sum.a < vm.own[0].w) break;
  }
  return sum;
}

void main() {
  colour = vec4(0.);
  vec3 origin = ray_origin(ndc), direction = ray_direction(ndc);
  float z0 = vm.depth.x, z1 = 1e30;
  clip_ray(origin, direction, z0, z1);
  if (!(z0 < z1)) return;
  Walk walk = walk_of(origin, direction, z0, z1);
  colour = VM_CLASSIFICATION == 2 ? march_segments(walk) : march_samples(walk);
}
