// The instruction sets every Highway file of the house is compiled for: include this before anything of Highway.
// x86: AVX-512 (AVX3), AVX2 and SSE4, which is the least that the cpu backend asks for (its factory checks). More sets
// would only cost compile time; without a baseline of SSE4 Highway would add a scalar one.
#pragma once

// Bits 0..7: everything above AVX3 (AVX3_DL and, in later Highways, ZEN4 and SPR); 12: SSSE3; 14: SSE2.
#define HWY_DISABLED_TARGETS (0xFFLL | (1LL << 12) | (1LL << 14))
#if defined(__x86_64__) || defined(_M_X64)
#define HWY_BASELINE_TARGETS (1LL << 11)
#endif
