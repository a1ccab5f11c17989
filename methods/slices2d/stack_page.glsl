// One page of a stack (stacks.h): stored slices as tiles of a 2D texture. Goes behind volume_common.glsl; its twin is
// stack_page-inl.h. A program that includes it leaves these to page_uniforms.h:
// vm.own[1]: xy: a tile in texture coordinates; zw: texture coordinates in the tile per coordinate of the slice alone.
// vm.own[2]: xy: gutter in texture coordinates; z: tiles in a row; w: first stored slice of the page.
// vm.own[3].w: last stored slice of the page.
layout(binding = 4) uniform sampler2D page;

// Texture coordinates of a slice alone.
vec2 place_in_slice(vec3 box) { return clamp(box.xy, 0., 1.) * vm.texture_scale.xy + vm.texture_offset.xy; }

// Texture coordinates of the page, of a point of a stored slice that is on it.
vec2 place_on_page(float stored, vec2 at) {
  float place = stored - vm.own[2].w;
  float row = floor((place + .5) / vm.own[2].z);
  vec2 tile = vec2(place - row * vm.own[2].z, row);
  return tile * vm.own[1].xy + vm.own[2].xy + at * vm.own[1].zw;
}
vec4 texel_of(float stored, vec2 at) { return textureLod(page, place_on_page(stored, at), 0.); }
