// One ray a fragment. The stretch of the ray inside the (clipped) volume is cut into segments of one step from where it
// enters; the last one ends where the ray leaves. Segment k begins at entry + k stride: never accumulated, so that
// skipping, which jumps over whole segments, leaves the others where they were. Twin: raycast_cpu.cpp.
VM_SPEC(6, VM_SKIP_EMPTY, 0)

// Chebyshev distance of each brick to the nearest occupied one, in 1/255: all bricks nearer than it are transparent.
layout(binding = 4) uniform sampler3D brick_distances;

layout(location = 0) in vec2 ndc;
layout(location = 0) out vec4 colour;

// vm.own[0]: bricks along each axis; w: transmittance below which a ray ends.
// vm.own[1]: bricks per box coordinate; w: bricks per cell, 0 where nothing is skipped.
// vm.own[2]: x < s_n < y holds for every value that is not transparent.

// A ray in units of one step. Positions in box coordinates and in bricks.
struct Walk {
  vec3 entry, stride;
  float steps;  // length
  int count;    // segments
  vec3 brick_entry, brick_stride, brick_inverse;
};

vec3 position_of(Walk walk, float k) { return walk.entry + k * walk.stride; }

// Where the ray leaves the transparent cube around `position` (in bricks), in steps; negative in an occupied brick.
float empty_until(Walk walk, vec3 position) {
  vec3 last = vm.own[0].xyz - 1.;
  vec3 brick = clamp(floor(position), vec3(0.), last);
  float distance = floor(texelFetch(brick_distances, ivec3(brick), 0).r * 255. + .5);
  if (distance == 0.) return -1.;
  vec3 face = mix(brick - distance + 1., brick + distance, greaterThanEqual(walk.brick_stride, vec3(0.)));
  vec3 k = (face - walk.brick_entry) * walk.brick_inverse;
  return min(k.x, min(k.y, k.z));
}

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

// The first segment from k on that does not lie in transparent bricks as a whole.
int next_segment(Walk walk, int k) {
  while (k < walk.count) {
    float until = empty_until(walk, walk.brick_entry + float(k) * walk.brick_stride);
    int next = until >= walk.steps ? walk.count : int(floor(until));
    if (next <= k) break;
    k = next;
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
  float step_z = vm.depth.w / ray_length(direction);
  Walk walk;
  walk.entry = origin + z0 * direction;
  walk.stride = direction * step_z;
  walk.steps = (z1 - z0) / step_z;
  walk.count = int(ceil(walk.steps));
  walk.brick_entry = walk.entry * vm.own[1].xyz;
  walk.brick_stride = walk.stride * vm.own[1].xyz;
  // Along an axis that the ray does not move on, no face is ever reached.
  walk.brick_inverse = mix(1. / walk.brick_stride, vec3(1e18), lessThan(abs(walk.brick_stride), vec3(1e-18)));
  colour = VM_CLASSIFICATION == 2 ? march_segments(walk) : march_samples(walk);
}
