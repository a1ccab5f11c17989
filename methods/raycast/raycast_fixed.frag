// One ray a fragment in the arithmetic of the boards of 2000: samples every step along the ray, counted from the plane
// where the volume begins, and blended in levels as an 8-bit frame buffer would. Twin: raycast_fixed_cpu.cpp.
VM_SPEC(5, VM_SKIP_EMPTY, 0)

// Chebyshev distance of each brick to the nearest occupied one, in 1/255: all bricks nearer than it are transparent.
layout(binding = 3) uniform sampler3D brick_distances;
layout(location = 0) out vec4 colour;

// 1 / |d| to float precision: Newton's method from a guess by bits. Unlike the built-in it has the same bits
// everywhere.
float inverse_length(vec3 d) {
  precise float q = (d.x * d.x + d.y * d.y) + d.z * d.z;
  precise float half_q = .5 * q;
  precise float r = intBitsToFloat(0x5f375a86 - (floatBitsToInt(q) >> 1));
  r = r * (1.5 - (half_q * r) * r);
  r = r * (1.5 - (half_q * r) * r);
  r = r * (1.5 - (half_q * r) * r);
  r = r * (1.5 - (half_q * r) * r);
  return r;
}

// How many samples from the one at t on (depth z) are certainly transparent; 0 in an occupied brick. Samples keep their
// places, so that rounding here decides no bit either.
int empty_samples(ivec3 t, float z, vec3 origin, vec3 direction, float step_z) {
  int shift = int(fx.bricks.w);
  ivec3 brick = clamp((t >> 8) >> shift, ivec3(0), ivec3(fx.bricks.xyz));
  int reach = int(texelFetch(brick_distances, brick, 0).r * 255. + .5);
  if (reach == 0) return 0;
  bvec3 forward = greaterThanEqual(direction, vec3(0.));
  vec3 face =
      vec3((brick + mix(ivec3(1 - reach), ivec3(reach), forward)) << shift) + mix(vec3(.02), vec3(-.02), forward);
  vec3 until = (face - origin) / direction;
  return int(clamp((min(until.x, min(until.y, until.z)) - z) / step_z, 1., 65536.));
}

void main() {
  vec3 origin = window_origin(), direction = window_direction();
  precise vec3 world = direction * fx.metric.xyz;
  // Along an orthographic ray depth is length.
  precise float step_z = fx.depth.y * (fx.depth.z * inverse_length(world) + (1. - fx.depth.z));
  // Which samples may lie inside. Rounding here decides nothing: the box is taken a little larger, two samples are
  // added, and each sample is tested on its own.
  vec3 d = mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
  vec3 reach = fx.limit.xyz / 512., middle = (reach - origin) / d;
  reach = abs((reach + .05) / d);
  vec3 enter = middle - reach, leave = middle + reach;
  float z0 = max(enter.x, max(enter.y, enter.z)), z1 = min(leave.x, min(leave.y, leave.z));
  int k = int(clamp((z0 - fx.depth.x) / step_z - 2., 0., fx.limit.w));
  int end = int(clamp((z1 - fx.depth.x) / step_z + 2., 0., fx.limit.w));
  ivec4 sum = ivec4(0);
  for (; k < end; ++k) {
    float z = depth_of(float(k), step_z);
    ivec3 t = position_of(origin, direction, z);
    if (VM_SKIP_EMPTY == 1) {
      int skipped = empty_samples(t, z, origin, d, step_z);
      if (skipped > 0) {
        k += skipped - 1;
        continue;
      }
    }
    sum = min(sum + product(sample_at(t), ivec4(255 - sum.a)), 255);
    if (float(255 - sum.a) < fx.lighting.w) break;
  }
  colour = vec4(sum) / 255.;
}
