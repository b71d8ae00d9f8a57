// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lib/balance/regressor.hpp"
#include "lib/core/joint.hpp"
#include "lib/identify/extra/extra_term.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// A combination of masses, first moments and inertias that torques determine apart from the others.
struct BaseParameter {
  std::string
      name;  ///< a, b, c, m3 of a SCARA; else the inertial number it is gathered in, such as "I1", "mx2"
  std::string unit;       ///< kg m^2, kg m or kg
  std::string meaning;    ///< its sum, such as "I2 + 0.09 m3" at the lengths of `chain`
  bool is_mass = false;   ///< the mass of a link, as m3 of a SCARA
  bool is_rotor = false;  ///< inertia of a rotor, which acts on its own joint alone
  Joint joint = 1_joint;  ///< of a rotor; the first one for other parameters
};

/// The parameters that motion and torque of a robot depend on, in this order: base parameters, then for every
/// joint fv, fc, offset, bend, skew, then the extra terms, phi (torque timing) and ln(friction width) of
/// every joint. Torques are linear in all but the widths.
struct ParameterSpace {
  Chain chain;  ///< geometry, lengths, gravity, rotor inertia that is no base parameter, the width of bent
                ///< friction, the rates of ripples, the drives of shared friction and its width; its links
                ///< and other friction do not count
  std::vector<BaseParameter> base;
  /// (11 n) x base: the links' inertial numbers, then the rotors' inertia, that represent the base
  /// parameters.
  Eigen::MatrixXd lift;
  std::vector<ExtraTerm> extra;

  int joints() const { return chain.joints(); }
  int rigid() const { return static_cast<int>(base.size()); }
  int viscous(int j) const { return rigid() + j; }
  int coulomb(int j) const { return rigid() + joints() + j; }
  int offset(int j) const { return rigid() + 2 * joints() + j; }
  int bend(int j) const { return rigid() + 3 * joints() + j; }
  int skew(int j) const { return rigid() + 4 * joints() + j; }
  int extra_begin() const { return rigid() + 5 * joints(); }
  int timing() const { return extra_begin() + static_cast<int>(extra.size()); }
  int log_width(int j) const { return timing() + 1 + j; }
  int count() const { return timing() + 1 + joints(); }
  /// Number of parameters in which torques are linear: all before the widths.
  int linear() const { return timing() + 1; }

  /// Returns the joint of a parameter; the first one for the timing and base parameters other than rotors.
  Joint joint_of(int parameter) const;
  bool is_extra(int parameter) const { return parameter >= extra_begin() && parameter < timing(); }
  /// Returns the extra term of a parameter that is_extra().
  const ExtraTerm& extra_at(int parameter) const { return extra[parameter - extra_begin()]; }
  /// Whether a parameter is an inertia and not friction: base parameters and rotors of shared drives.
  bool is_inertial(int parameter) const {
    return parameter < rigid() ||
           (is_extra(parameter) && extra_at(parameter).kind == ExtraKind::shared_inertia);
  }
  std::string name(int parameter) const;
  std::string unit(int parameter) const;
};

/// Returns the base parameters by rank over random states, so that every torque that the robot's link shapes
/// allow can be formed: a, b, c, m3 for SCARA orders, else the inertial numbers themselves, base first, then
/// the rotors that act apart from the links (Gautier and Khalil 1990; Atkeson, An and Hollerbach 1986).
ParameterSpace parameter_space(const Robot& robot);

/// Returns the chain with these parameters. Its masses and first moments represent the base parameters and
/// need not be those of the real links.
Chain chain_from(const ParameterSpace& space, const Eigen::VectorXd& parameters);

/// Returns the parameters of `robot` in `space`: the base parameters whose torques are nearest to its own,
/// its friction, `phi`.
Eigen::VectorXd parameters_of(const ParameterSpace& space, Chain chain, double phi);

/// Returns the map from the numbers of links and rotors to base parameters: base x (11 n).
Eigen::MatrixXd base_map(const ParameterSpace& space);

/// Whether `joints` have `joint`.
bool has_joint(const std::vector<Joint>& joints, Joint joint);

/// Returns the largest of the values, one a joint, among the joints of the same kind as joint `j`.
double largest_alike(const ParameterSpace& space, const Eigen::VectorXd& values, int j);

/// Whether the robot file gives a parameter of friction exactly (Robot::known); false for base parameters.
bool is_given_exactly(const ParameterSpace& space, const Robot& robot, int parameter);

/// Parameters to be estimated from logs.
struct WantedParameters {
  std::vector<bool> asked;     ///< not given exactly, nor friction of a joint that never moves
  std::vector<bool> optional;  ///< of those, kept only if they lower the held-out error: rotors, offsets,
                               ///< bent, skew and extra terms
};

/// Returns the parameters to be estimated. `still` are the joints that never move: at rest their
/// friction may be anything up to stiction. Offsets, bends and skews are asked for only with `try_offsets`.
WantedParameters wanted_parameters(const ParameterSpace& space, const Robot& robot,
                                   const std::vector<Joint>& still, bool try_offsets);

/// Returns the change of the base parameters by 1 kg at the end of each link: base parameters x links.
Eigen::MatrixXd payload_columns(const ParameterSpace& space);

}  // namespace faultline
