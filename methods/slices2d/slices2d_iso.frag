// One slice of an isosurface in 2D textures by the alpha test (rezksalama2000, section 7): whether the stretch of the
// pixel's ray between this slice and the next shows the surface, and with what colour. All coordinates are in the
// stack's frame: z runs across the slices. Twin: slices2d_iso_twin.cpp.
VM_SPEC(6, VM_REFINE, 0)       // 1: on the line between both ends of the stretch
VM_SPEC(7, VM_GRADIENTS, 0)    // 0: texels are values; 1: gradient and value; 2: normal and value
VM_SPEC(8, VM_INTERPOLATE, 1)  // 0: the nearest stored slice; 1: their eq. 1
layout(location = 0) in float slab;
layout(location = 0) out vec4 colour;

// vm.own[0]: NDC = window * xy + (-1, 1); w: stored slices less one.
// vm.own[3]: x: z of the middle of slab 0; y: thickness of a slab. A slab lies between two slices; beyond the first and
// the last one it ends where the volume does.
float slice_position(float k) { return clamp(vm.own[3].x + k * vm.own[3].y, 0., 1.); }

// At z of the stack.
vec4 texel_at(vec3 box, float z) {
  vec2 at = place_in_slice(box);
  float first = vm.own[2].w, last = vm.own[3].w, place = z * vm.own[0].w;
  if (VM_INTERPOLATE == 0) return texel_of(clamp(roundEven(place), first, last), at);
  float below = clamp(floor(place), first, max(last - 1., first));
  return mix(texel_of(below, at), texel_of(min(below + 1., last), at), clamp(place - below, 0., 1.));
}
float value_of(vec4 texel) { return ((VM_GRADIENTS == 0 ? texel.r : texel.a) - vm.value.x) * vm.value.y; }

void main() {
  vec2 ndc = gl_FragCoord.xy * vm.own[0].xy + vec2(-1., 1.);
  vec3 origin = ray_origin(ndc), direction = ray_direction(ndc);
  float enter = vm.depth.x, leave = 1e30;
  clip_ray(origin, direction, enter, leave);
  float inverse = 1. / (abs(direction.z) < 1e-20 ? 1e-20 : direction.z), k = floor(slab + .5);
  float low = slice_position(k - .5), high = slice_position(k + .5);
  // The slice that the ray meets first, and the one behind it.
  float near = inverse > 0. ? low : high, far = inverse > 0. ? high : low;
  float z_near = (near - origin.z) * inverse, z_far = (far - origin.z) * inverse;
  float z0 = max(enter, z_near), z1 = min(leave, z_far);
  float slack = kSlack * min(vm.own[3].y * abs(inverse), leave - enter);
  if (!(enter < leave && z0 <= z1 + slack)) discard;
  // At a slice z is that of the slice, to the bit, so that all pixels take the same stored ones.
  vec3 begin = origin + z0 * direction;
  vec4 texel = texel_at(begin, z_near >= enter ? near : begin.z);
  float met;
  if (VM_REFINE == 1) {
    vec3 end = origin + z1 * direction;
    met = meet_line(value_of(texel), value_of(texel_at(end, z_far <= leave ? far : end.z)));
  } else {
    met = meet_slice(value_of(texel));
  }
  if (met > 1.) discard;
  colour = vec4(surface.colour.rgb, 1.);
#ifndef VM_WITHOUT_LIGHTING
  if (VM_LIGHTS > 0) {
    vec3 hit = VM_REFINE == 1 ? origin + mix(z0, z1, met) * direction : begin;
    if (VM_REFINE == 1) texel = texel_at(hit, hit.z);
    vec3 vector = texel.rgb * surface.vectors.x + surface.vectors.y;
    colour = shade_surface(VM_GRADIENTS == 1 ? normal_of(vector) : vector, hit);
  }
#endif
}
