layout(location = 0) in vec4 corner;
layout(location = 0) out vec3 place;
void main() {
  gl_Position = vec4(corner.xy, 0, 1);
  place = vec3(corner.xy * 0.5 + 0.5, corner.z);
}
