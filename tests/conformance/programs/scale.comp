layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Parameters { float factor; uint count; };
layout(std430, binding = 1) readonly buffer Source { float source[]; };
layout(std430, binding = 2) buffer Result { float result[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < count) result[i] = source[i] * factor + float(gl_WorkGroupID.x);
}
