#include "tanglebin/report/page.hpp"

#include <fmt/format.h>

#include "tanglebin/report/document.hpp"
#include "tanglebin/report/embedded.hpp"
#include "tanglebin/report/plot.hpp"
#include "tanglebin/report/scene_view.hpp"
#include "tanglebin/report/script.hpp"
#include "tanglebin/report/sections.hpp"

namespace tanglebin {
namespace {

constexpr const char* contents = R"html(<nav aria-label="Contents">
<ul>
<li><a href="#leaderboard">Leaderboard</a></li>
<li><a href="#table-1">Generation time</a></li>
<li><a href="#table-2">Modelling time</a></li>
<li><a href="#figure-8">Micro-recall by number of tubes</a></li>
<li><a href="#figure-9">Micro-recall by ratio</a></li>
<li><a href="#measures">Other measures</a></li>
<li><a href="#runs">All runs</a></li>
<li><a href="#scenes">Scenes in 3D</a></li>
<li><a href="#pictures">Pictures</a></li>
<li><a href="#repeat">How to make this page again</a></li>
</ul>
</nav>
)html";

constexpr const char* citation = R"html(<footer>
<p>The paper: G. Leão, C. M. Costa, A. Sousa, L. P. Reis, G. Veiga: <cite>Using Simulation to Evaluate a Tube Perception
Algorithm for Bin Picking.</cite> Robotics 11(2), 46, 2022.
<a href="https://doi.org/10.3390/robotics11020046">doi:10.3390/robotics11020046</a>. Published numbers are from its
Tables 1 and 2 and the text of its Section 6.2. Sets A and B are compared with the paper's sets of the same name.</p>
</footer>
)html";

std::string head(const Results& results) {
  return fmt::format("<style>{}{}</style>\n{}", plot_style, embedded::runs_css,
                     results.scenes.empty() ? "" : scene_style());
}

/// Only those that have something to do. The table of runs asks the scenes which of them are there.
std::string scripts(const Results& results) {
  std::string html = results.scenes.empty() ? "" : scene_scripts();
  if (!results.scores.empty()) html += script(embedded::chart_js) + script(embedded::runs_js);
  return html;
}

}  // namespace

std::string report_page(const Results& results, const std::string& page) {
  return html_document("Tanglebin report", head(results),
                       overview(results) + contents + "<main>\n" +  //
                           leaderboard(results) +                   //
                           generation_times(results) +              // Table 1
                           modelling_times(results) +               // Table 2
                           recall_by_tubes(results) +               // Figure 8
                           recall_by_ratio(results) +               // Figure 9
                           other_measures(results) +                //
                           all_runs(results) +                      //
                           scenes_in_3d(results) +                  //
                           example_pictures(results) +              //
                           how_to_repeat(results, page) + "</main>\n" + (results.is_papers ? citation : "") +
                           scripts(results));
}

}  // namespace tanglebin
