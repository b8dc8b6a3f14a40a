#include "tanglebin/model/axis_method.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "tanglebin/base/picked.hpp"
#include "tanglebin/model/range_image.hpp"
#include "tanglebin/model/step_clock.hpp"

namespace tanglebin {
namespace {

// The points of the fragments of each tube are that tube's.
std::vector<std::int32_t> claimed_points(std::size_t points, const AxisModel& found,
                                         const std::vector<std::vector<std::size_t>>& members) {
  std::vector<std::int32_t> labels(points, null_label);
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (const std::size_t fragment : members[i]) {
      for (const std::size_t point : found.fragments[fragment].points) {
        labels[found.model.filtered[point]] = found.model.tubes[i].id;
      }
    }
  }
  return labels;
}

}  // namespace

AxisModel model_by_axes(const PointCloud& cloud, const KnownScene& known, double ratio, std::uint64_t seed,
                        const AxisSettings& settings) {
  AxisModel result;
  Model& model = result.model;
  StepClock clock(model.steps);

  const std::vector<std::size_t> cropped = crop(cloud, known.bin, settings.filter);
  model.filtered = downsample(cropped, ratio, seed);
  const std::vector<Eigen::Vector3f> points = picked(cloud.points, model.filtered);
  clock.end_step("filter", points.size(), "points");

  result.votes = vote_for_axes(points, known, settings.vote);
  clock.end_step("vote", result.votes.votes.size(), "votes");

  result.fragments = find_fragments(result.votes, known.radius, known.junctions > 0, settings.fragment);
  clock.end_step("fragment", result.fragments.size(), "fragments");

  const RangeImage seen(cloud, known.camera);
  result.links = find_links(result.fragments, seen, known, settings.link);
  result.chosen = choose_links(result.fragments, result.links, known, settings.link);
  const std::vector<std::vector<std::size_t>> members =
      linked_fragments(result.fragments.size(), result.links, result.chosen);
  clock.end_step("join", members.size(), "tubes");

  for (const std::vector<std::size_t>& fragments : members) {
    model.tubes.push_back(fit_tube(result.fragments, fragments, result.links, result.chosen, points,
                                   known.radius, settings.fit));
    model.tubes.back().id = static_cast<int>(model.tubes.size());
  }
  clock.end_step("fit", model.tubes.size(), "tubes");

  model.labels = label_points(cloud, cropped, claimed_points(cloud.points.size(), result, members),
                              model.tubes, settings.label);
  clock.end_step("label",
                 static_cast<std::size_t>(std::ranges::count_if(
                     model.labels, [](std::int32_t label) { return label > bin_label; })),
                 "points");
  return result;
}

}  // namespace tanglebin
