// Put in front by the programs of lit shells.
#define VM_SHELL_LIT
