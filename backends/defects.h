// Planted errors, for the mutation check of the stability suite (tests/defects): a hard case must catch each of them.
// Only that test is compiled with VOLUMARK_DEFECTS; in every other build defect() is constantly false and the compiler
// leaves nothing of the places that ask.
#pragma once

namespace volumark {

// Named after what is wrong; tests/defects/defect_list.h says it in a sentence.
enum class Defect {
  None,
  LinearOpacity,
  NaiveExponential,
  HalfVoxelShift,
  MiscountedCells,
  MissingFace,
  MissingEdge,
  UnguardedDivision,
  FlippedParallel,
  RayLengthIgnored,
  NearPlaneIgnored,
  LostSlice,
  DoubledEdge,
  DroppedLastSlab,
  UnclippedLastSegment,
  SwappedSlices,
  TerminatesOnOpacity,
  BricksMissNeighbours,
  ShiftedTable,
  CancellingSelfAttenuation,
  UnassociatedColours,
  IsotropicGradients,
  PlacedInFloat,
  AxesTransposed,
  SignedOffByOne,
  UnnormalisedHalfway,
  UnboundedNormal,
  OrderIgnored,
  LostEdge,
  WrongStack,
  ForgottenGutter,
  EyeForgotten,
};

#ifdef VOLUMARK_DEFECTS
inline namespace with_defects {
inline Defect planted_defect = Defect::None;
inline bool defect(Defect kind) { return planted_defect == kind; }
}  // namespace with_defects
#else
constexpr bool defect(Defect) { return false; }
#endif

}  // namespace volumark
