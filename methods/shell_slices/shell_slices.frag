// One sample of one slice through a shell: what a slab of thickness shell.texture.z around the plane adds to the pixel's
// ray. Twin: shell_twin.cpp.
layout(binding = 1) uniform sampler3D colours;  // (emission, extinction)

layout(location = 0) in vec3 in_texture;
layout(location = 0) out vec4 colour;

void main() {
  vec2 slope = (gl_FragCoord.xy * shell.window.xy + vec2(-1., 1.)) * shell.window.zw;
  float len = shell.texture.z * sqrt(1. + dot(slope, slope));
  // The texture repeats on all axes: w is kept away from the border, where it would meet its other end.
  vec3 at = vec3(in_texture.xy, clamp(in_texture.z, shell.texture.x, shell.texture.y));
  vec4 texel = textureLod(colours, at, 0.) * shell.texture.w;
  float alpha = VM_LINEAR_OPACITY == 1 ? min(texel.a * len, 1.) : exact_opacity(texel.a * len);
  colour = vec4(texel.rgb * (texel.a > 1e-30 ? alpha / texel.a : len), alpha);
}
