layout(binding = 1) uniform sampler3D source;
layout(location = 0) in vec4 v_colour;  // texture coordinates
layout(location = 0) out vec4 out_colour;
void main() { out_colour = textureLod(source, v_colour.xyz, 0.0); }
