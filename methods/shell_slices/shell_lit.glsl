// Put in front by the programs of lit shells.
#ifndef VM_WITHOUT_LIGHTING
#define VM_SHELL_LIT
#endif
