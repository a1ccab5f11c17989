// Put in front of volume_common.glsl: lighting there reads the volume's 3D texture, and this family has none.
#define VM_WITHOUT_LIGHTING
