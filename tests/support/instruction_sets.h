#pragma once

#include <vector>

#include "core/instruction_set.h"

namespace nacre::testing {

/// All that this build has kernels for and this processor has, the baseline first.
inline std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set :
       {InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512}) {
    if (has_instruction_set(set)) sets.push_back(set);
  }
  return sets;
}

}  // namespace nacre::testing
