// Put in front of volume_common.glsl by programs whose normals do not come from the 3D texture.
#define VM_NORMALS_GIVEN
