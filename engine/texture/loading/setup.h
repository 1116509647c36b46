#pragma once
// From genesis to an assembly: the specimen in solver order, its contact groups, and the input of a test.
#include <vector>

#include "engine/texture/genesis/specimen.h"
#include "engine/texture/laws/properties.h"
#include "engine/texture/loading/test.h"
#include "engine/texture/solver/input.h"

namespace dem::texture {

/// Everything that a case of this model depends on. SI units.
struct Settings {
  Test test;
  PackingSettings packing;
  std::vector<Mineral> minerals;
  Interaction interaction;
  Attenuated attenuated = Attenuated::unlike_minerals;
  GrainShape shape;
  GrowthRule growth = GrowthRule::deepest_contact;
  double seed_scale = 1;
  JointModulus joint_modulus = JointModulus::sum;
  bool same_mineral_boundaries = true;  ///< grains of one mineral meet in parallel bonds too
  bool one_mineral = false;             ///< the specimen is of one mineral alone, flat joints throughout
  double damping = 0.7;
  double time_step_factor = 0.8;
  double gauge = 0.6;                 ///< length of the strain gauge over the height
  double rate_bias = 0.03;            ///< that is let pass
  double stiffness_departure = 0.02;  ///< of the axial stiffness at crack initiation
};

/// The body of the test: that which it cuts, or the cylinder as packed.
Body body_of(const Settings& settings);

/// A specimen in the order of the solver.
struct Specimen {
  Packing packing;
  GrainSeeds seeds;
  GrainMap grains;
  std::vector<BondSpec> bonds;  ///< one for each contact of the packing, in its order
};

/// Genesis, growth and contact groups (steps 1 to 4), reordered for the solver.
Specimen make_specimen(const Settings& settings, RunContext& context);

/// The files of its packing and seeds in context.specimens, and only those made.
std::vector<std::string> specimen_files(const Settings& settings);
void keep_specimen(const Settings& settings, RunContext& context);

/// Step 4 alone: the law and the parameters of each contact.
std::vector<BondSpec> group_contacts(const Packing& packing, const GrainMap& grains, const Settings& settings);

/// The specimen between the platens, or in the grips, of its test.
AssemblyInput assembly_input(const Specimen& specimen, const Settings& settings);

}  // namespace dem::texture
