// Common header of every program: one GLSL 4.50 text for GL and Vulkan. Stands right after the #version line.
// VM_SPEC(id, name, default): an int constant fixed when the program is made (ProgramDesc::constants, in id order).
// VM_VERTEX, VM_INSTANCE: index of the vertex and of the instance, both counted from 0.
#ifdef VULKAN
#define VM_SPEC(id, name, value) layout(constant_id = id) const int name = value;
#define VM_VERTEX gl_VertexIndex
#define VM_INSTANCE gl_InstanceIndex
#else
// The gl backend puts `const int name = value;` for every constant right after the #version line.
#define VM_SPEC(id, name, value)
#define VM_VERTEX gl_VertexID
#define VM_INSTANCE gl_InstanceID
#endif
