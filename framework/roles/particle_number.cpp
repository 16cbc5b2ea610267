#include "framework/roles/particle_number.hpp"

#include <algorithm>
#include <cmath>

#include "framework/slam/pose_clusters.hpp"
#include "framework/slam/view_fit.hpp"

namespace ppm {

namespace {
constexpr double kPlaceWeight = 0.01;  // what a cluster must hold to be a place in question
}

void ParticleNumber::declare(Params& params) {
  params
      .add_choice("number", rule_,
                  {{"kept", Rule::kept}, {"fixed", Rule::fixed}, {"kld", Rule::kld}, {"need", Rule::need}})
      .doc(
          "Number of particles after resampling: as many as there are; fixed (`particles`); kld: as many as represent the "
          "spread of the poses (KLD-sampling); need: few where the best particle's view is explained and the particles "
          "agree, many where not.");
  params.add("particles", fixed_).range(0, 1'000'000).doc("Number of particles for `number: fixed`.");
  params.add("least", least_).range(1, 1'000'000).doc("Fewest particles for `number: kld` and `need`.");
  params.add("most", most_).range(1, 1'000'000).doc("Most particles for `number: kld` and `need`.");
  params.add("kld_error", kld_.error)
      .range(0, 10)
      .above(0)
      .doc("`number: kld`: the Kullback-Leibler divergence, in nats, that the particles may have from what they stand for.");
  params.add("kld_quantile", quantile_)
      .range(0.5, 0.999999)
      .doc("`number: kld`: the probability with which that bound is to hold.");
  params.add("bin_t", bin_t_)
      .unit("m")
      .range(0, 100)
      .above(0)
      .doc("Edge of a bin of positions for `number: kld`; for `need` the distance below which particles mean one place.");
  params.add("bin_r", bin_r_)
      .unit("rad")
      .range(0, 4)
      .above(0)
      .doc("Edge of a bin of rotations, and the angle below which particles mean one place.");
  params.add("outliers_few", outliers_few_)
      .range(0, 1)
      .doc("`number: need`: up to this share of outliers in the best particle's view the least number will do.");
  params.add("outliers_many", outliers_many_)
      .range(0, 1)
      .doc("`number: need`: from this share of outliers on the largest number is asked for.");
  params.add("per_place", per_place_)
      .range(1, 1'000'000)
      .doc("`number: need`: particles for each place in question, a cluster of poses that holds 1 % of the weight.");
  params.add("slack", slack_)
      .range(0, 1)
      .doc("`number: kld` and `need`: a number that differs by no more than this share from the present one changes nothing.");
  params.add("fall", fall_)
      .range(0, 1)
      .above(0)
      .doc("`number: kld` and `need`: share of the surplus that goes in a frame; growth is at once.");
}

void ParticleNumber::open() {
  if (rule_ == Rule::fixed && fixed_ == 0) throw ConfigError({}, "`number: fixed` needs the parameter 'particles'");
  if (rule_ != Rule::fixed && fixed_ != 0)
    throw ConfigError({}, "'particles' is given, but the number is not `number: fixed`");
  if (least_ > most_) throw ConfigError({}, fmt::format("'least' ({}) is above 'most' ({})", least_, most_));
  if (outliers_few_ >= outliers_many_)
    throw ConfigError({}, fmt::format("'outliers_few' ({}) is not below 'outliers_many' ({})", outliers_few_, outliers_many_));
  kld_.z = normal_quantile(quantile_);
  kld_.least = static_cast<std::size_t>(least_);
  kld_.most = static_cast<std::size_t>(most_);
}

std::size_t ParticleNumber::wanted(ParticleSet& belief, std::span<const double> weights, Rng rng) const {
  const std::size_t now = belief.size();
  if (rule_ == Rule::kept) return now;
  if (rule_ == Rule::fixed) return static_cast<std::size_t>(fixed_);
  const std::size_t asked = belief.lost           ? kld_.least
                            : rule_ == Rule::kld ? by_spread(belief, weights, rng)
                                                 : by_need(belief, weights);
  const double present = static_cast<double>(now), change = static_cast<double>(asked) - present;
  const bool out_of_bounds = now < kld_.least || now > kld_.most;
  if (std::abs(change) <= slack_ * present && !out_of_bounds) return now;
  return change > 0 ? asked : asked + static_cast<std::size_t>((1 - fall_) * -change);
}

std::size_t ParticleNumber::by_spread(const ParticleSet& belief, std::span<const double> weights, Rng rng) const {
  return kld_number(weights, pose_bins(belief.pose, belief.pose[belief.best()], bin_t_, bin_r_), kld_, rng);
}

std::size_t ParticleNumber::by_need(ParticleSet& belief, std::span<const double> weights) const {
  if (!belief.columns().contains(kViewFitColumn))
    throw ConfigError({}, "`number: need` follows how views fit, which no node above says; a 'weighting.*' does");
  const double outliers = belief.column<ViewFit>(kViewFitColumn)[belief.best()].outliers;
  const double u = std::clamp((outliers - outliers_few_) / (outliers_many_ - outliers_few_), 0.0, 1.0);
  const double few = static_cast<double>(least_), many = static_cast<double>(most_);
  const auto for_fit = static_cast<std::size_t>(std::lround(few * std::pow(many / few, u)));
  const auto places = std::ranges::count_if(pose_clusters(belief.pose, weights, bin_t_, bin_r_),
                                            [](const PoseCluster& c) { return c.weight >= kPlaceWeight; });
  const auto for_places = static_cast<std::size_t>(places) * static_cast<std::size_t>(per_place_);
  return std::clamp(std::max(for_fit, for_places), kld_.least, kld_.most);
}

}  // namespace ppm
