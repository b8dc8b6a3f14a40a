#include "tanglebin/score/score.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "any_array.hpp"
#include "arrays.hpp"
#include "tanglebin/score/score_clouds.hpp"
#include "tanglebin/score/score_tubes.hpp"

namespace tanglebin::python {
namespace {

void bind_measures(py::module_& module) {
  py::class_<Detection>(module, "Detection", doc::score::Detection)
      .def_readonly("precision", &Detection::precision, doc::score::Detection_precision)
      .def_readonly("recall", &Detection::recall, doc::score::Detection_recall)
      .def_readonly("f1", &Detection::f1, doc::score::Detection_f1)
      .def_readonly("panoptic_quality", &Detection::panoptic_quality, doc::score::Detection_panoptic_quality);
  py::class_<Instances>(module, "Instances", doc::score::Instances)
      .def_readonly("correct", &Instances::correct, doc::score::Instances_correct)
      .def_readonly("over_segmented", &Instances::over_segmented, doc::score::Instances_over_segmented)
      .def_readonly("under_segmented", &Instances::under_segmented, doc::score::Instances_under_segmented)
      .def_readonly("missed", &Instances::missed, doc::score::Instances_missed)
      .def_readonly("noise", &Instances::noise, doc::score::Instances_noise);
  py::class_<TubeScore>(module, "TubeScore", doc::score::TubeScore)
      .def_readonly("label", &TubeScore::label, "the tube's true label")
      .def_readonly("points", &TubeScore::points, "its points")
      .def_readonly("assigned", &TubeScore::assigned, doc::score::TubeScore_assigned)
      .def_readonly("correct_points", &TubeScore::correct_points, doc::score::TubeScore_correct_points)
      .def_readonly("null_points", &TubeScore::null_points, doc::score::TubeScore_null_points)
      .def_readonly("iou", &TubeScore::iou, doc::score::TubeScore_iou);
  py::class_<Score>(module, "Score", doc::score::Score)
      .def_readonly("micro_recall", &Score::micro_recall, doc::score::Score_micro_recall)
      .def_readonly("points", &Score::points, "on tubes, in the ground truth")
      .def_readonly("correct_points", &Score::correct_points,
                    "of these, with the label assigned to their tube")
      .def_readonly("null_points", &Score::null_points, "of these, without a predicted label")
      .def_readonly("mean_iou", &Score::mean_iou, doc::score::Score_mean_iou)
      .def_readonly("detection", &Score::detection, doc::score::Detection)
      .def_readonly("adjusted_rand_index", &Score::adjusted_rand_index, doc::score::adjusted_rand_index)
      .def_readonly("unmixed_recall", &Score::unmixed_recall, doc::score::Score_unmixed_recall)
      .def_readonly("instances", &Score::instances, doc::score::Instances)
      .def_readonly("tubes", &Score::tubes, doc::score::Score_tubes);
  py::class_<TubesScore>(module, "TubesScore", doc::score::TubesScore)
      .def_readonly("centre_line_error", &TubesScore::centre_line_error,
                    doc::score::TubesScore_centre_line_error)
      .def_readonly("centre_line_error_p95", &TubesScore::centre_line_error_p95,
                    doc::score::TubesScore_centre_line_error_p95)
      .def_readonly("centre_line_coverage", &TubesScore::centre_line_coverage,
                    doc::score::TubesScore_centre_line_coverage)
      .def_readonly("complete_tubes", &TubesScore::complete_tubes, doc::score::TubesScore_complete_tubes)
      .def_readonly("length_error", &TubesScore::length_error, doc::score::TubesScore_length_error)
      .def_readonly("true_joins", &TubesScore::true_joins, doc::score::TubesScore_true_joins)
      .def_readonly("joins_found", &TubesScore::joins_found, doc::score::TubesScore_joins_found)
      .def_readonly("joins_made", &TubesScore::joins_made, doc::score::TubesScore_joins_made)
      .def_readonly("true_junctions", &TubesScore::true_junctions, doc::score::TubesScore_true_junctions)
      .def_readonly("junctions_found", &TubesScore::junctions_found, doc::score::TubesScore_junctions_found)
      .def_readonly("junctions_made", &TubesScore::junctions_made, doc::score::TubesScore_junctions_made);
}

}  // namespace

void bind_score(py::module_& module) {
  bind_measures(module);
  module.def(
      "score",
      [](const AnyArray& truth, const AnyArray& predicted, const std::optional<AnyArray>& mixed) {
        const auto true_labels = integers_of<std::int32_t>(truth, "truth");
        const auto labels = integers_of<std::int32_t>(predicted, "predicted");
        const auto marks = mixed ? integers_of<std::uint8_t>(*mixed, "mixed") : std::vector<std::uint8_t>{};
        return without_gil([&] { return score(true_labels, labels, marks); });
      },
      py::arg("truth"), py::arg("predicted"), py::arg("mixed") = py::none(), doc::score::score);
  module.def(
      "score_clouds",
      [](const PointCloud& truth, const PointCloud& labelled, const std::string& truth_file,
         const std::string& labelled_file) {
        return without_gil([&] { return score_clouds(truth, truth_file, labelled, labelled_file); });
      },
      py::arg("truth"), py::arg("labelled"), py::arg("truth_file") = "truth",
      py::arg("labelled_file") = "labelled", doc::score::score_clouds);
  module.def(
      "score_tubes",
      [](const std::vector<Tube>& truth, const std::vector<Tube>& modelled) {
        return without_gil([&] { return score_tubes(truth, modelled); });
      },
      py::arg("truth"), py::arg("modelled"), doc::score::score_tubes);
}

}  // namespace tanglebin::python
