#include "engine/texture/laws/flat_joint.h"

#include <algorithm>
#include <cmath>

namespace dem::texture {
namespace {

constexpr double half = 0.5;
Triple<double> unit(const Triple<double>& a) { return (1.0 / root(dot(a, a))) * a; }

struct Arms {
  Triple<double> rho[3];
};

Arms arms(const PartlyBrokenJoint& joint, const Pose<double>& one, const Motion<double>& m) {
  Triple<double> e1 = rotate(one.q, joint.zero_angle);
  e1 = unit(e1 - dot(e1, m.n) * m.n);
  const Triple<double> e2 = cross(m.n, e1);
  Arms a;
  for (int e = 0; e < 3; ++e) {
    a.rho[e] = (joint.law.rho * element_cosine[e]) * e1 + (joint.law.rho * element_sine[e]) * e2;
  }
  return a;
}

struct ElementMotion {
  double gap;
  Triple<double> shear;  ///< displacement from the stress-free place
};

ElementMotion element_motion(const Motion<double>& m, const Triple<double>& rho, const JointElement& element,
                             const Pose<double>& one) {
  ElementMotion r;
  r.gap = m.gap + dot(m.n, cross(m.theta_t, rho));
  r.shear = m.u + m.theta_n * cross(m.n, rho);
  if (element.bonded == 0) {
    const Triple<double> slip = rotate(one.q, element.slip);
    r.shear = r.shear - (slip - dot(slip, m.n) * m.n);
  }
  return r;
}

}  // namespace

Triple<double> any_perpendicular(const Triple<double>& d) {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  const Triple<double> axis = x <= y && x <= z ? Triple<double>{1, 0, 0}
                              : y <= z         ? Triple<double>{0, 1, 0}
                                               : Triple<double>{0, 0, 1};
  return unit(cross(d, axis));
}

JointResult advance(PartlyBrokenJoint& joint, const Pose<double>& one, const Pose<double>& two) {
  JointResult result;
  if (stays_open(joint, one, two)) return result;
  const Motion<double> m = motion(one, two, joint.reference, joint.share_one, joint.reference_length);
  // Nothing acts while no point of the rim can touch.
  if (joint.broken() && m.gap > 0 && m.gap * m.gap > joint.law.rho * joint.law.rho * dot(m.theta_t, m.theta_t)) {
    if (joint.open == 0) {
      for (JointElement& element : joint.element) {  // the mean of the last friction and none, over the slip
        result.friction_heat +=
            half * (joint.law.normal / 3.0 * joint.law.inverse_ratio) * dot(element.shear, element.shear);
        element.shear = {0, 0, 0};
      }
      joint.open = 1;
    }
    return result;
  }
  const Arms arm = arms(joint, one, m);
  const double kn = joint.law.normal / 3.0;  // of an element, N/m
  const double ks = kn * joint.law.inverse_ratio;
  const bool torn = mismatched(m);
  const bool closes = joint.open != 0;
  joint.open = 0;
  Triple<double> force{0, 0, 0}, couple{0, 0, 0};
  for (int e = 0; e < 3; ++e) {
    JointElement& element = joint.element[e];
    ElementMotion at = element_motion(m, arm.rho[e], element, one);
    if (closes) {  // it touches free of shear where it is now
      element.slip = element.slip + rotate_back(one.q, at.shear);
      at.shear = {0, 0, 0};
    }
    double length = root(dot(at.shear, at.shear));
    const Triple<double> whole = (-kn * at.gap) * m.n - ks * at.shear;
    const double before = half * (kn * at.gap * at.gap + ks * length * length);
    bool breaks_now = false, in_shear = false;
    if (element.bonded != 0) {
      if (at.gap > joint.law.opening) {
        breaks_now = true;
      } else if (length * joint.law.inverse_ratio > joint.law.cohesion - at.gap * joint.law.tan_phi) {
        breaks_now = in_shear = true;
      } else if (torn) {
        breaks_now = true;
        in_shear = at.gap < 0;
      }
      element.bonded = breaks_now ? 0 : 1;
    }
    double normal = kn * at.gap;
    if (element.bonded == 0) {
      normal = std::min(normal, 0.0);
      const double limit = -joint.friction * normal;  // N
      const double trial = ks * length;
      if (trial > limit) {
        const double keep = limit / trial;
        const Triple<double> lost = (1.0 - keep) * at.shear;
        element.slip = element.slip + rotate_back(one.q, lost);
        at.shear = keep * at.shear;
        if (!breaks_now) result.friction_heat += (half * ks) * dot(element.shear + at.shear, lost);
        length *= keep;
      }
    }
    element.shear = at.shear;
    if (breaks_now) {
      const double gap = std::min(at.gap, 0.0);
      const double after = half * (kn * gap * gap + ks * length * length);
      const Triple<double> gone = whole - ((-normal) * m.n - ks * at.shear);
      result.broke[result.breaks++] = {e,
                                       in_shear,
                                       one.x + (joint.share_one * m.length) * m.n + arm.rho[e],
                                       m.n,
                                       0.0,
                                       before - after,
                                       action_at_contact(m, joint.share_one, gone, cross(arm.rho[e], gone))};
    }
    const Triple<double> f = (-normal) * m.n - ks * at.shear;
    force = force + f;
    couple = couple + cross(arm.rho[e], f);
  }
  result.action = action_at_contact(m, joint.share_one, force, couple);
  return result;
}

double stored(const PartlyBrokenJoint& joint, const Pose<double>& one, const Pose<double>& two) {
  if (joint.open != 0) return 0;
  const Motion<double> m = motion(one, two, joint.reference, joint.share_one, joint.reference_length);
  const Arms arm = arms(joint, one, m);
  const double kn = joint.law.normal / 3.0, ks = kn * joint.law.inverse_ratio;
  double sum = 0;
  for (int e = 0; e < 3; ++e) {
    const ElementMotion at = element_motion(m, arm.rho[e], joint.element[e], one);
    const double gap = joint.element[e].bonded != 0 ? at.gap : std::min(at.gap, 0.0);
    sum += half * (kn * gap * gap + ks * dot(at.shear, at.shear));
  }
  return sum;
}

}  // namespace dem::texture
