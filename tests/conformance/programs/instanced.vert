layout(location = 0) in vec4 position;
layout(location = 1) in vec4 offset;  // per instance
layout(location = 0) out vec4 v_colour;
void main() {
  gl_Position = position + offset;
  gl_PointSize = 1.0;
  v_colour = vec4(float(VM_INSTANCE), float(VM_VERTEX), 0.0, 1.0);
}
