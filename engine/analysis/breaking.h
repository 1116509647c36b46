#pragma once
// How a block of the lattice comes apart, read off its record: pieces, where the first bonds break, how the stress falls on
// the way to the peak, what energy is left.
#include "engine/core/record.h"

namespace dem::analysis {

/// Pieces of at least `least` of the elements that unbroken bonds hold together.
int pieces_of(const Record& record, double least = 0.02);

/// Of the first broken bonds, a hundredth of all but at least ten, the share with an element on the outside of the block, over
/// the share of such bonds among all: above 1, cracks begin at the boundary.
double first_at_boundary(const Record& record);

/// Share of the bonds opened at the peak that have opened before the stress (Pa) is first reached.
double opened_below(const Record& record, double stress);

/// The largest fall of the stress between two times (s), over the stress that it falls from; only while bonds break.
double largest_fall(const Record& record, double from, double to);

/// Stress over strain at a time against the same at a third of that strain: 1 on a straight line.
double straightness(const Record& record, double time);

/// Least elastic energy after a time over that at the time.
double elastic_left(const Record& record, double time);
/// Kinetic energy at the end of the record over its largest after a time.
double kinetic_left(const Record& record, double time);
/// Breaking heat after a time over all of it.
double breaking_after(const Record& record, double time);

}  // namespace dem::analysis
