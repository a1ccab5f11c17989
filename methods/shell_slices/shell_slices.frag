// One sample of one slice through a shell: what a slab of thickness shell.texture.z around the plane adds to the pixel's
// ray. The volumetric texture (emission, extinction) is volume_texture of volume_common.glsl. Twin: shell_twin.cpp.
layout(location = 0) in vec3 in_texture;
#ifdef VM_SHELL_LIT
layout(location = 1) in vec3 in_box;
layout(location = 2) in vec3 in_gradient_u;
layout(location = 3) in vec3 in_gradient_v;
layout(location = 4) in vec3 in_gradient_w;
#endif
layout(location = 0) out vec4 colour;

// The texture repeats on all axes: w is kept away from the border, where it would meet its other end.
vec3 within(vec3 at) { return vec3(at.xy, clamp(at.z, shell.texture.x, shell.texture.y)); }

#ifdef VM_SHELL_LIT
float extinction_at(vec3 at) { return textureLod(volume_texture, within(at), 0.).a; }

// Of the extinction, as scenes/shell.h defines it, carried over to world space.
vec3 world_gradient(vec3 at) {
  vec3 e = shell.texel.xyz;
  vec3 d = vec3(extinction_at(at + vec3(e.x, 0., 0.)) - extinction_at(at - vec3(e.x, 0., 0.)),
                extinction_at(at + vec3(0., e.y, 0.)) - extinction_at(at - vec3(0., e.y, 0.)),
                extinction_at(at + vec3(0., 0., e.z)) - extinction_at(at - vec3(0., 0., e.z))) * shell.slope.xyz;
  return d.x * in_gradient_u + d.y * in_gradient_v + d.z * in_gradient_w;
}
#endif

void main() {
  vec2 slope = (gl_FragCoord.xy * shell.window.xy + vec2(-1., 1.)) * shell.window.zw;
  float len = shell.texture.z * sqrt(1. + dot(slope, slope));
  vec3 at = within(in_texture);
  vec4 texel = textureLod(volume_texture, at, 0.) * shell.texture.w;
  float alpha = opacity_of(texel.a * len);
  vec3 emission = texel.rgb;
#ifdef VM_SHELL_LIT
  vec3 diffuse = vec3(vm.lighting.x), specular = vec3(0.);
  add_lights(normal_of(world_gradient(at)), in_box, diffuse, specular);
  emission = emission * diffuse + texel.a * specular;
#endif
  colour = vec4(emission * (texel.a > 1e-30 ? alpha / texel.a : len), alpha);
}
