#pragma once
// How a block of the lattice comes apart, read off its record: pieces, where the first bonds break, how the stress falls on
// the way to the peak, what energy is left.
#include <span>

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

/// A fall of the stress, from its largest value up to a time; its end is the least one before the stress is as large again.
struct Fall {
  double time = 0, strain = 0, stress = 0;  ///< of its beginning: s, 1, Pa
  double low_time = 0, low_stress = 0;      ///< of its end
};
/// The one that goes on at a time (s): the drop at A1 of the lattice in compression, at the time when most bonds open.
Fall fall_at(const Record& record, double time);

/// Largest kinetic energy from a time (s) on over the work done by then.
double kinetic_over_work(const Record& record, double time);
/// Viscous heat over all heat, at the end.
double viscous_share(const Record& record);

/// Stress over strain at a time against the same at a third of that strain: 1 on a straight line.
double straightness(const Record& record, double time);

/// Least elastic energy after a time over that at the time.
double elastic_left(const Record& record, double time);
/// The time at which it is least.
double time_of_least_elastic(const Record& record, double from);
/// Kinetic energy at the end of the record over its largest after a time.
double kinetic_left(const Record& record, double time);
/// Breaking heat after a time over all of it.
double breaking_after(const Record& record, double time);

/// Elastic energy lost between two times over that at the first.
double elastic_loss(const Record& record, double from, double to);
/// Heat of all kinds until a time over that at the end.
double heat_until(const Record& record, double time);
/// Breaking heat between two times over that at the end, of both springs; the same of the shear springs alone.
double breaking_between(const Record& record, double from, double to);
double shear_breaking_between(const Record& record, double from, double to);
/// Breaking heat between two times over the elastic energy at the first.
double breaking_over_elastic(const Record& record, double from, double to);
/// Of the steps between neighbouring times, how many take stress and elastic energy the same way.
int steps_alike(const Record& record, std::span<const double> times);

}  // namespace dem::analysis
