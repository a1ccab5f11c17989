layout(binding = 0) uniform sampler3D volume;
layout(location = 0) in vec3 place;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(texture(volume, place).r * 0.01); }
