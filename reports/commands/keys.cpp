// dem-report keys: the reference of the scenario keys. docs/use/keys.md is what `keys --markdown` prints.
#include <fmt/format.h>

#include <iostream>

#include "engine/model/model.h"
#include "engine/scenario/scenario.h"
#include "reports/commands/verbs.h"

namespace cli {
namespace {

/// Of the scenario as such and of every model, or of `model` alone.
std::string keys_text(const std::string& model) {
  std::string text = "Keys of every scenario\n" + dem::explain(dem::common_keys());
  for (const dem::Model& one : dem::models()) {
    if (!model.empty() && one.name != model) continue;
    text += fmt::format("\nKeys of model = \"{}\"\n{}", one.name, dem::explain(one.keys()));
  }
  return text;
}

int perform(const Arguments& arguments) {
  const std::string& model = arguments.word("MODEL");
  const std::string text = keys_text(model);
  if (!arguments.has("markdown")) {
    std::cout << text;
    return 0;
  }
  const std::string command = "dem-report keys" + (model.empty() ? "" : " " + model);
  std::cout << fmt::format(
      "# Scenario keys\n\nThe output of `{}`. Quantities are written with their unit, as in\n"
      "`diameter = \"25 mm\"`.\n\n```text\n{}```\n",
      command, text);
  return 0;
}

}  // namespace

Command verbs::keys() {
  std::vector<std::string> models;
  for (const dem::Model& model : dem::models()) models.emplace_back(model.name);
  return {.name = "keys",
          .summary = "list the scenario keys with unit, range and default",
          .positionals = {{.name = "MODEL",
                           .help = "only the keys of this model, and those of every scenario",
                           .least = 0,
                           .choices = models}},
          .options = {{.name = "markdown", .help = "as a page in Markdown: docs/use/keys.md is made with it"}},
          .examples = {{"dem-report keys grain_texture", "what a scenario of the grain texture model may say"},
                       {"dem-report keys --markdown > docs/use/keys.md", "make the page of the documentation anew"}},
          .exit_codes = usual_exit_codes(),
          .perform = perform};
}

}  // namespace cli
