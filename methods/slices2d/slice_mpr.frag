// One strip of a single slice of any direction (rezksalama2000, section 9): the two stored slices beside it, weighted,
// and the transfer function's colour, opaque. All coordinates are in the stack's frame: z runs across the slices. Twin:
// slice_mpr_twin.cpp.
VM_SPEC(6, VM_INTERPOLATE, 1)     // 0: the stored slice of the strip alone
VM_SPEC(7, VM_CORNER_WEIGHTS, 1)  // 1: of the strip's corners, interpolated; 0: of the pixel's own place

layout(location = 0) in vec3 strip;  // y: first of the two stored slices; z: weight of the second
layout(location = 0) out vec4 colour;

// vm.own[0]: xy: NDC = window * xy + (-1, 1); z: distance of the plane; w: stored slices less one.
// vm.own[3]: xyz: normal of the plane, which has dot(xyz, box) = distance.

void main() {
  vec2 ndc = gl_FragCoord.xy * vm.own[0].xy + vec2(-1., 1.);
  vec3 direction = ray_direction(ndc), origin = ray_origin(ndc);
  float slope = dot(vm.own[3].xyz, direction);
  float z = (vm.own[0].z - dot(vm.own[3].xyz, origin)) / (abs(slope) < 1e-20 ? 1e-20 : slope);
  vec3 box = origin + z * direction;
  float below = clamp(floor(strip.y + .5), vm.own[2].w, vm.own[3].w);
  vec2 at = place_in_slice(box);
  vec4 texel = texel_of(below, at);
  if (VM_INTERPOLATE == 1) {
    float weight = VM_CORNER_WEIGHTS == 1 ? strip.z : box.z * vm.own[0].w - below;
    texel = mix(texel, texel_of(min(below + 1., vm.own[3].w), at), clamp(weight, 0., 1.));
  }
  if (VM_CLASSIFICATION == 1) {
    colour = vec4(texel.rgb, 1.);
  } else {
    colour = vec4(transfer((texel.r - vm.value.x) * vm.value.y).rgb, 1.);
  }
#ifndef VM_WITHOUT_CLIP_PLANES
  for (int i = 0; i < VM_CLIP_PLANES; ++i) {
    if (dot(vm.clip_planes[i].xyz, box) < vm.clip_planes[i].w) colour = vec4(0.);
  }
#endif
}
