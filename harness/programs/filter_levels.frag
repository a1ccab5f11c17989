// 4096 places (64 x 64 pixels), evenly spread between the centres of the two texels of `source`.
layout(binding = 0) uniform sampler3D source;
layout(location = 0) out vec4 colour;

void main() {
  float place = floor(gl_FragCoord.y) * 64. + gl_FragCoord.x;
  colour = textureLod(source, vec3(.25 + .5 * place / 4096., .5, .5), 0.);
}
