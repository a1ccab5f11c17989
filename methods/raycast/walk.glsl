// A ray cut into segments of one step, and the bricks of empty space that it may jump over. Behind volume_common.glsl; the
// twin is march-inl.h.
VM_SPEC(6, VM_SKIP_EMPTY, 0)

// Chebyshev distance of each brick to the nearest occupied one, in 1/255: all bricks nearer than it are transparent.
layout(binding = 4) uniform sampler3D brick_distances;

// vm.own[0].xyz: bricks along each axis.
// vm.own[1]: bricks per box coordinate; w: bricks per cell, 0 where nothing is skipped.

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

// Of the ray's part from z0 to z1, z0 < z1.
Walk walk_of(vec3 origin, vec3 direction, float z0, float z1) {
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
  return walk;
}
