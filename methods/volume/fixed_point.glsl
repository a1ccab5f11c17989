// The effect fixed_point on the GPU: the arithmetic of the boards of 2000, the same bits on every backend. The
// definition and its sources are in docs/effects.md, the C++ side is fixed_point.h, the twin on SIMD lanes
// fixed_point-inl.h.
//
// Levels are integers that stand for k / 255. Positions are texel coordinates: sample (i, j, k) lies at (i, j, k); t
// counts in 1/256 of a texel. Up to t everything is float arithmetic in a fixed order, `precise` so that no compiler
// fuses or reorders it; from t on all is integers. Nothing here divides.
//
// A program that includes this text declares bindings 0..2 and constants 0..4. VM_TEXELS_GIVEN, defined in front of it,
// is for programs whose texels are not in a 3D texture: they define texel_red and texel_rgba, and binding 1 as they like.
VM_SPEC(0, VM_CLASSIFIED, 0)  // 1: texels hold associated colours and opacities
#ifndef VM_WITHOUT_LIGHTING
VM_SPEC(1, VM_LIGHTS, 0)    // number of lights; texels then hold normals, and the value as alpha
VM_SPEC(2, VM_SPECULAR, 0)  // 0: no specular term; otherwise one more than how often it is squared
VM_SPEC(3, VM_TWO_SIDED, 0)
#endif
#ifndef VM_WITHOUT_CLIP_PLANES
VM_SPEC(4, VM_CLIP_PLANES, 0)  // number of clip planes
#endif

struct FixedLight {
  vec4 direction;  // signed levels, local frame
  vec4 halfway;
  vec4 diffuse;  // levels
  vec4 specular;
};

layout(std140, binding = 0) uniform FixedUniforms {
  vec4 origin, origin_x, origin_y;           // texel coordinates at window (0, 0), and per pixel right and down
  vec4 direction, direction_x, direction_y;  // texels per unit of depth
  vec4 metric;                               // world units a texel
  vec4 depth;                                // x: where samples begin; y: step, world units; z: 1 in perspective
  vec4 limit;                                // largest t; w: more samples a ray does not have
  vec4 last;                                 // largest texel index
  vec4 lighting;                             // ambient, levels; w: a ray ends where fewer levels pass it
  vec4 counts;                               // lights, clip planes, squarings + 1, 1 two-sided: for the CPU twin
  vec4 bricks;                               // last brick index; w: a brick is 2^w texels wide
  vec4 clip_planes[16];                      // keeps dot(xyz, t) >= w
  FixedLight lights[8];
}
fx;

#ifndef VM_TEXELS_GIVEN
layout(binding = 1) uniform sampler3D volume_texture;
#endif
layout(binding = 2) uniform sampler1D palette;

// ---- Positions ----
vec3 window_origin() {
  precise vec3 p = (fx.origin.xyz + gl_FragCoord.x * fx.origin_x.xyz) + gl_FragCoord.y * fx.origin_y.xyz;
  return p;
}
vec3 window_direction() {
  precise vec3 d = (fx.direction.xyz + gl_FragCoord.x * fx.direction_x.xyz) + gl_FragCoord.y * fx.direction_y.xyz;
  return d;
}
// Depth of sample k where samples are step_z apart.
float depth_of(float k, float step_z) {
  precise float z = fx.depth.x + (k + .5) * step_z;
  return z;
}
ivec3 position_of(vec3 origin, vec3 direction, float z) {
  precise vec3 p = origin + z * direction;
  precise vec3 t = floor(clamp(p, vec3(-16.), vec3(16384.)) * 256. + .5);
  return ivec3(t);
}

bool inside(ivec3 t) {
  bool kept = all(greaterThanEqual(t, ivec3(0))) && all(lessThanEqual(t, ivec3(fx.limit.xyz)));
#ifndef VM_WITHOUT_CLIP_PLANES
  vec3 p = vec3(t);
  for (int i = 0; i < VM_CLIP_PLANES; ++i) {
    vec4 plane = fx.clip_planes[i];
    precise float side = (plane.x * p.x + plane.y * p.y) + plane.z * p.z;
    kept = kept && side >= plane.w;
  }
#endif
  return kept;
}

// ---- Levels ----
// The product of two levels, as the frame buffers of the software drivers have it: a b / 255 to nearest, but for a few
// just above a half.
ivec4 product(ivec4 a, ivec4 b) {
  ivec4 p = a * b;
  return (p + (p >> 8) + 128) >> 8;
}
int product(int a, int b) {
  int p = a * b;
  return (p + (p >> 8) + 128) >> 8;
}
ivec3 product(ivec3 a, ivec3 b) {
  ivec3 p = a * b;
  return (p + (p >> 8) + 128) >> 8;
}
// A dot product of signed levels, clamped to [-255, 255].
int dot_product(ivec3 a, ivec3 b) {
  ivec3 p = a * b;
  int sum = p.x + p.y + p.z, m = abs(sum);
  m = min((m + (m >> 8) + 128) >> 8, 255);
  return sum < 0 ? -m : m;
}

// ---- Texture filter: weights of 8 bits, each interpolation rounded to 8 bits ----
int interpolated(int a, int b, int f) { return a + (((b - a) * f + 128) >> 8); }
ivec4 interpolated(ivec4 a, ivec4 b, int f) { return a + (((b - a) * f + 128) >> 8); }
#ifdef VM_TEXELS_GIVEN
int texel_red(int x, int y, int z);
ivec4 texel_rgba(int x, int y, int z);
#else
int texel_red(int x, int y, int z) { return int(texelFetch(volume_texture, ivec3(x, y, z), 0).r * 255. + .5); }
ivec4 texel_rgba(int x, int y, int z) { return ivec4(texelFetch(volume_texture, ivec3(x, y, z), 0) * 255. + .5); }
#endif

int filtered_red(ivec3 t) {
  ivec3 last = ivec3(fx.last.xyz), a = min(t >> 8, last), b = min(a + 1, last), f = t & 255;
  int y0 = interpolated(texel_red(a.x, a.y, a.z), texel_red(b.x, a.y, a.z), f.x);
  int y1 = interpolated(texel_red(a.x, b.y, a.z), texel_red(b.x, b.y, a.z), f.x);
  int y2 = interpolated(texel_red(a.x, a.y, b.z), texel_red(b.x, a.y, b.z), f.x);
  int y3 = interpolated(texel_red(a.x, b.y, b.z), texel_red(b.x, b.y, b.z), f.x);
  return interpolated(interpolated(y0, y1, f.y), interpolated(y2, y3, f.y), f.z);
}
ivec4 filtered_rgba(ivec3 t) {
  ivec3 last = ivec3(fx.last.xyz), a = min(t >> 8, last), b = min(a + 1, last), f = t & 255;
  ivec4 y0 = interpolated(texel_rgba(a.x, a.y, a.z), texel_rgba(b.x, a.y, a.z), f.x);
  ivec4 y1 = interpolated(texel_rgba(a.x, b.y, a.z), texel_rgba(b.x, b.y, a.z), f.x);
  ivec4 y2 = interpolated(texel_rgba(a.x, a.y, b.z), texel_rgba(b.x, a.y, b.z), f.x);
  ivec4 y3 = interpolated(texel_rgba(a.x, b.y, b.z), texel_rgba(b.x, b.y, b.z), f.x);
  return interpolated(interpolated(y0, y1, f.y), interpolated(y2, y3, f.y), f.z);
}

ivec4 palette_at(int level) { return ivec4(texelFetch(palette, level, 0) * 255. + .5); }

// ---- Combiners: signed levels, clamped after every step ----
#ifndef VM_WITHOUT_LIGHTING
ivec3 lit(ivec3 colour, ivec3 stored_normal) {
  ivec3 n = 2 * stored_normal - 255;
  ivec3 diffuse = ivec3(fx.lighting.xyz), specular = ivec3(0);
  for (int i = 0; i < VM_LIGHTS; ++i) {
    int nl = dot_product(n, ivec3(fx.lights[i].direction.xyz));
    int facing = VM_TWO_SIDED == 1 ? abs(nl) : max(nl, 0);
    diffuse = min(diffuse + product(ivec3(facing), ivec3(fx.lights[i].diffuse.xyz)), 255);
    if (VM_SPECULAR > 0) {
      int nh = dot_product(n, ivec3(fx.lights[i].halfway.xyz));
      nh = VM_TWO_SIDED == 1 ? abs(nh) : (nl > 0 ? max(nh, 0) : 0);
      for (int k = 1; k < VM_SPECULAR; ++k) nh = product(nh, nh);
      specular = min(specular + product(ivec3(nh), ivec3(fx.lights[i].specular.xyz)), 255);
    }
  }
  return min(product(colour, diffuse) + specular, 255);
}
#endif

// Premultiplied colour and opacity of the sample at t, levels; nothing outside of the volume.
ivec4 sample_at(ivec3 t) {
  if (!inside(t)) return ivec4(0);
  if (VM_CLASSIFIED == 1) return filtered_rgba(t);
#ifndef VM_WITHOUT_LIGHTING
  if (VM_LIGHTS > 0) {
    ivec4 texel = filtered_rgba(t), entry = palette_at(texel.a);
    if (entry.a == 0) return ivec4(0);
    return ivec4(product(lit(entry.rgb, texel.rgb), ivec3(entry.a)), entry.a);
  }
#endif
  ivec4 entry = palette_at(filtered_red(t));
  return ivec4(product(entry.rgb, ivec3(entry.a)), entry.a);
}
