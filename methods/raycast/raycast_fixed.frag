// One ray a fragment in the arithmetic of the boards of 2000: samples every step along the ray, counted from the plane
// where the volume begins, and blended in levels as an 8-bit frame buffer would. Twin: raycast_fixed_cpu.cpp.
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
    ivec4 s = sample_at(position_of(origin, direction, depth_of(float(k), step_z)));
    sum = min(sum + product(s, ivec4(255 - sum.a)), 255);
    if (float(255 - sum.a) < fx.lighting.w) break;
  }
  colour = vec4(sum) / 255.;
}
