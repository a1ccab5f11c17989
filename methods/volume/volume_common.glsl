// What volume methods share on the GPU: the uniform block, sampling, classification, lighting, clipping of a ray.
// The twin on SIMD lanes is volume_twin-inl.h, function by function; the C++ side of the block is volume_uniforms.h.
//
// Coordinates. Box: [0,1]^3 over the volume. Local: the volume's own axes, world units, origin at the middle of the box;
// box = local / extent + .5. Lights and eye are given in the local frame, so no matrix is needed here.
// Rays. A pixel's ray is P(z) = origin + z * direction in box coordinates, with z the depth along the view direction in
// world units, counted from a reference plane near the volume. `origin` and `direction` are affine in NDC (x, y), for
// perspective and orthographic views alike. A stretch dz of the ray is ray_length(direction) * dz world units long.
//
// A program that includes this text declares bindings 0..3 and constants 0..5; its own start at binding 4, constant 6.
// Effects. A constant of 0 removes what simulates an effect; VM_WITHOUT_LIGHTING and VM_WITHOUT_CLIP_PLANES, defined in
// front of this text, remove its words too: what is compiled then must be the same, and a test compares.
// VM_NORMALS_GIVEN, defined in front of it, is for programs whose normals do not come from the 3D texture: they light by
// add_lights themselves, and shade_segment and shade_preintegrated do not.
// Period arithmetic (fixed_point) is no branch of these programs but programs of its own: fixed_point.glsl.
VM_SPEC(0, VM_CLASSIFICATION, 0)  // 0 post, 1 pre, 2 pre-integrated
VM_SPEC(1, VM_LINEAR_OPACITY, 0)  // 1: alpha = min(tau d, 1) instead of 1 - exp(-tau d)
#ifndef VM_WITHOUT_LIGHTING
VM_SPEC(2, VM_LIGHTS, 0)          // number of lights; 0: no lighting is simulated
VM_SPEC(3, VM_SPECULAR, 0)        // 1: the specular term is not zero
VM_SPEC(4, VM_TWO_SIDED, 0)
#endif
#ifndef VM_WITHOUT_CLIP_PLANES
VM_SPEC(5, VM_CLIP_PLANES, 0)     // number of clip planes
#endif

struct VolumeLight {
  vec4 vector;  // local frame; w = 0: unit direction towards the light, w = 1: position
  vec4 colour;
};

layout(std140, binding = 0) uniform VolumeUniforms {
  vec4 ray_origin, ray_origin_x, ray_origin_y;           // box coordinates: at NDC (0, 0), and per unit of NDC x and y
  vec4 ray_direction, ray_direction_x, ray_direction_y;  // box coordinates per unit of z
  vec4 depth;           // x: z of the near plane; y, z: z where the (clipped) volume begins and ends; w: step, world units
  vec4 extent;          // world units; w: smallest spacing
  vec4 size;            // samples; w: 1 / smallest spacing
  vec4 texture_scale;   // texture coordinate = box * scale + offset, texel centres at the samples
  vec4 texture_offset;
  vec4 texel;           // texture coordinates between neighbouring samples
  vec4 value;           // s_n = (stored - x) * y; z: transfer table size - 1; w: pre-integration table size - 1
  vec4 gradient_scale;  // smallest spacing / spacing; w: length below which the normal shortens
  vec4 eye;             // local frame; w: 1 perspective, 0 orthographic
  vec4 forward;         // local frame, unit
  vec4 lighting;        // ambient, diffuse, specular, shininess
  vec4 counts;          // lights, clip planes, 1 with specular, 1 two-sided: what the constants say, for the CPU twin
  vec4 own[4];          // free for the method
  vec4 clip_planes[16]; // box coordinates: keeps dot(xyz, box) >= w
  VolumeLight lights[64];
} vm;

layout(binding = 1) uniform sampler3D volume_texture;        // scalar, or with pre classification associated RGBA
layout(binding = 2) uniform sampler1D transfer_table;        // (r, g, b, tau)
layout(binding = 3) uniform sampler2D preintegrated_table;   // x: front, y: back; (emission, extinction), means

// ---- Rays ----
vec3 ray_origin(vec2 ndc) { return vm.ray_origin.xyz + ndc.x * vm.ray_origin_x.xyz + ndc.y * vm.ray_origin_y.xyz; }
vec3 ray_direction(vec2 ndc) {
  return vm.ray_direction.xyz + ndc.x * vm.ray_direction_x.xyz + ndc.y * vm.ray_direction_y.xyz;
}
float ray_length(vec3 direction) { return length(direction * vm.extent.xyz); }

// Clips [z0, z1] of the ray to the box and the clip planes; empty where z0 >= z1.
void clip_ray(vec3 origin, vec3 direction, inout float z0, inout float z1) {
  // Between the two faces of an axis: |centre + z direction| <= .5. A direction of 0 is taken as next to nothing, which
  // makes the slab between the faces everything or nothing.
  vec3 d = mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
  vec3 inverse = 1. / d;
  vec3 middle = (.5 - origin) * inverse, reach = abs(.5 * inverse);
  vec3 enter = middle - reach, leave = middle + reach;
  z0 = max(max(z0, enter.x), max(enter.y, enter.z));
  z1 = min(min(z1, leave.x), min(leave.y, leave.z));
#ifndef VM_WITHOUT_CLIP_PLANES
  for (int i = 0; i < VM_CLIP_PLANES; ++i) {
    float o = dot(vm.clip_planes[i].xyz, origin) - vm.clip_planes[i].w;
    float d = dot(vm.clip_planes[i].xyz, direction);
    if (d == 0.) {
      if (o < 0.) z1 = z0;
    } else if (d > 0.) {
      z0 = max(z0, -o / d);
    } else {
      z1 = min(z1, -o / d);
    }
  }
#endif
}

// ---- Sampling ----
vec3 texture_position(vec3 box) { return box * vm.texture_scale.xyz + vm.texture_offset.xyz; }

// The data value normalised by the transfer window, not clamped to it.
float sample_at(vec3 position) { return (textureLod(volume_texture, position, 0.).r - vm.value.x) * vm.value.y; }
float sample_value(vec3 box) { return sample_at(texture_position(box)); }
vec4 sample_classified(vec3 box) { return textureLod(volume_texture, texture_position(box), 0.); }

#if !defined(VM_WITHOUT_LIGHTING) && !defined(VM_NORMALS_GIVEN)
#define VM_SAMPLES_NORMALS
#endif
#ifdef VM_SAMPLES_NORMALS
// Central differences one sample apart, clamped at the border: equal to interpolating the stored gradient of
// scenes/scene.h. Change of s_n per two smallest spacings, local frame.
vec3 sample_gradient(vec3 box) {
  vec3 p = texture_position(box);
  vec3 e = vm.texel.xyz;
  vec3 after = vec3(sample_at(p + vec3(e.x, 0., 0.)), sample_at(p + vec3(0., e.y, 0.)), sample_at(p + vec3(0., 0., e.z)));
  vec3 before = vec3(sample_at(p - vec3(e.x, 0., 0.)), sample_at(p - vec3(0., e.y, 0.)), sample_at(p - vec3(0., 0., e.z)));
  return (after - before) * vm.gradient_scale.xyz;
}
#endif

// ---- Classification ----
// (r, g, b, tau) at s_n, by interpolation between table nodes with full float weights on every GPU.
vec4 transfer(float s) {
  float x = clamp(s, 0., 1.) * vm.value.z;
  float node = min(floor(x), vm.value.z - 1.);
  int i = int(node);
  return mix(texelFetch(transfer_table, i, 0), texelFetch(transfer_table, i + 1, 0), x - node);
}

// Mean emission and extinction along a segment on which s runs linearly from front to back.
vec4 transfer_segment(float front, float back) {
  vec2 x = clamp(vec2(front, back), 0., 1.) * vm.value.w;
  vec2 node = min(floor(x), vec2(vm.value.w - 1.));
  ivec2 i = ivec2(node);
  vec2 f = x - node;
  return mix(mix(texelFetch(preintegrated_table, i, 0), texelFetch(preintegrated_table, i + ivec2(1, 0), 0), f.x),
             mix(texelFetch(preintegrated_table, i + ivec2(0, 1), 0),
                 texelFetch(preintegrated_table, i + ivec2(1, 1), 0), f.x), f.y);
}

// Opacity of optical depth x >= 0: 1 - exp(-x) with full relative accuracy for small x (an expm1: GLSL has none).
// x = k ln 2 - r with |r| <= ln 2 / 2, and 1 - 2^-k e^r = (1 - 2^-k) - 2^-k (e^r - 1).
float opacity_of(float x) {
  if (VM_LINEAR_OPACITY == 1) return min(x, 1.);
  float y = min(x, 80.);
  float k = floor(y * 1.44269504 + .5);
  float r = (k * .693359375 - y) - k * 2.12194440e-4;
  float e = r * (1. + r * (1. / 2. + r * (1. / 6. + r * (1. / 24. + r * (1. / 120. + r * (1. / 720. + r * (1. / 5040.)))))));
  float p = intBitsToFloat((127 - int(k)) << 23);
  return (1. - p) - p * e;
}

// Opacity of a segment that is `ratio` voxels long where one voxel has opacity a: 1 - (1 - a)^ratio.
float correct_opacity(float a, float ratio) {
  float depth = a < .1 ? a * (1. + a * (1. / 2. + a * (1. / 3. + a * (1. / 4. + a * (1. / 5. + a * (1. / 6.))))))
                       : -log(max(1. - a, 1e-30));
  return opacity_of(depth * ratio);
}

// ---- Lighting (scenes/scene.h) ----
#ifndef VM_WITHOUT_LIGHTING
// Adds what the lights do at a point of unit normal n (or shorter, where the direction is not known): to what the colour
// is multiplied by (diffuse) and to what is added to it (specular).
void add_lights(vec3 n, vec3 box, inout vec3 diffuse, inout vec3 specular) {
  vec3 local = (box - .5) * vm.extent.xyz;
  // Without branches on uniforms: lavapipe would build the program anew for every frame's values of them.
  vec3 v = normalize(mix(-vm.forward.xyz, vm.eye.xyz - local, vm.eye.w));
  for (int i = 0; i < VM_LIGHTS; ++i) {
    vec4 light = vm.lights[i].vector;
    vec3 l = normalize(light.xyz - light.w * local);
    float nl = dot(n, l);
    diffuse += vm.lights[i].colour.rgb * (vm.lighting.y * (VM_TWO_SIDED == 1 ? abs(nl) : max(nl, 0.)));
    if (VM_SPECULAR == 1) {
      vec3 h = l + v;
      float h2 = dot(h, h);
      float nh = h2 > 0. ? dot(n, h) * inversesqrt(h2) : 0.;
      nh = VM_TWO_SIDED == 1 ? abs(nh) : (nl > 0. ? max(nh, 0.) : 0.);
      if (nh > 0.) specular += vm.lights[i].colour.rgb * (vm.lighting.z * pow(nh, vm.lighting.w));
    }
  }
}

// The normal of a gradient as sample_gradient() returns it.
vec3 normal_of(vec3 g) { return g / -max(length(g), vm.gradient_scale.w); }
#endif

#ifdef VM_SAMPLES_NORMALS
// The same at a sample, with the ambient light.
void light_sample(vec3 box, out vec3 diffuse, out vec3 specular) {
  diffuse = vec3(vm.lighting.x);
  specular = vec3(0.);
  add_lights(normal_of(sample_gradient(box)), box, diffuse, specular);
}
#endif

// ---- A segment of a ray: premultiplied colour and opacity ----
// Of constant colour and extinction (r, g, b, tau), `len` world units long, lit at `box`.
vec4 shade_segment(vec4 point, float len, vec3 box) {
  float alpha = opacity_of(point.a * len);
  vec3 colour = point.rgb;
#ifdef VM_SAMPLES_NORMALS
  if (VM_LIGHTS > 0) {
    if (alpha <= 0.) return vec4(0.);
    vec3 diffuse, specular;
    light_sample(box, diffuse, specular);
    colour = colour * diffuse + specular;
  }
#endif
  return vec4(colour * alpha, alpha);
}

// The same for a pre-integrated segment: mean emission and extinction of transfer_segment.
vec4 shade_preintegrated(vec4 mean, float len, vec3 box) {
  float x = mean.a * len;
  float alpha = opacity_of(x);
  vec3 colour = mean.rgb * (x > 1e-30 ? alpha / mean.a : len);
#ifdef VM_SAMPLES_NORMALS
  if (VM_LIGHTS > 0) {
    if (alpha <= 0.) return vec4(0.);
    vec3 diffuse, specular;
    light_sample(box, diffuse, specular);
    colour = colour * diffuse + specular * alpha;
  }
#endif
  return vec4(colour, alpha);
}

// The same for a pre-classified sample: associated colour and opacity over one voxel (the smallest spacing).
vec4 shade_classified(vec4 voxel, float len) {
  if (voxel.a <= 0.) return vec4(0.);
  float alpha = correct_opacity(voxel.a, len * vm.size.w);
  return vec4(voxel.rgb * (alpha / voxel.a), alpha);
}
