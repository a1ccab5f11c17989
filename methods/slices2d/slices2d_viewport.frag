// One strip of a slice perpendicular to the view, through two neighbouring stored slices (rezksalama2000, section 9):
// both textures, weighted, and the colour and opacity of the stretch of the pixel's ray inside the slab around the slice
// as in texture3d_slices.frag. All coordinates are in the stack's frame: z runs across the slices. Twin:
// slices2d_viewport_twin.cpp.
VM_SPEC(6, VM_CLIP_SLABS, 1)
VM_SPEC(7, VM_CORNER_WEIGHTS, 1)  // 1: of the strip's corners, interpolated; 0: of the pixel's own place

layout(location = 0) in vec3 strip;  // depth of the slice; first of the two stored slices; weight of the second
layout(location = 0) out vec4 colour;

// vm.own[0]: xy: NDC = window * xy + (-1, 1); w: stored slices less one.

void main() {
  vec2 ndc = gl_FragCoord.xy * vm.own[0].xy + vec2(-1., 1.);
  vec3 direction = ray_direction(ndc), box = ray_origin(ndc) + strip.x * direction;
  float below = floor(strip.y + .5);
  float weight = VM_CORNER_WEIGHTS == 1 ? strip.z : box.z * vm.own[0].w - below;
  float len = vm.depth.w;
  if (VM_CLIP_SLABS == 1) {
    float z0 = -.5 * vm.depth.w, z1 = .5 * vm.depth.w;
    clip_ray(box, direction, z0, z1);
    if (z1 <= z0) z0 = z1 = 0.;
    len = z1 - z0;
    // Where the slab is cut, the middle of what is left is not on the slice, and may lie in another strip.
    float moved = .5 * (z0 + z1);
    box += moved * direction;
    weight += moved * direction.z * vm.own[0].w;
    float there = clamp(moved == 0. ? below : below + floor(weight), 0., max(vm.own[0].w - 1., 0.));
    weight -= there - below;
    below = there;
    // Such a strip is drawn with several pages: one of them has it. Pages share two slices.
    float end = vm.own[3].w - (vm.own[3].w < vm.own[0].w ? 1. : -1.);
    if (below < vm.own[2].w || below >= end) len = 0.;
  }
  below = clamp(below, vm.own[2].w, vm.own[3].w);
  vec2 at = place_in_slice(box);
  vec4 texel = mix(texel_of(below, at), texel_of(min(below + 1., vm.own[3].w), at), clamp(weight, 0., 1.));
  len *= ray_length(direction);
  if (VM_CLASSIFICATION == 1) {
    colour = shade_classified(texel, len);
  } else {
    colour = shade_segment(transfer((texel.r - vm.value.x) * vm.value.y), len, box);
  }
}
