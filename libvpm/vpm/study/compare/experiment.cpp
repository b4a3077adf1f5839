// The sections of an experiment's file, and the product of its settings.
#include "vpm/study/compare/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "vpm/input/scene_file.h"
#include "vpm/input/table_reader.h"

namespace vpm {
namespace {

/// A value as TOML writes it.
std::string toml_text(const Node& node) {
  if (const auto* text = std::get_if<std::string>(&node.value)) return "\"" + *text + "\"";
  if (const auto* integer = std::get_if<int64_t>(&node.value)) return std::to_string(*integer);
  if (const auto* number = std::get_if<double>(&node.value)) return fmt::format("{}", *number);
  if (const auto* flag = std::get_if<bool>(&node.value)) return *flag ? "true" : "false";
  if (!node.array()) fail_at(node.place, "a setting cannot be " + kind_of(node));
  std::string all;
  for (const Node& element : *node.array()) all += (all.empty() ? "" : ", ") + toml_text(element);
  return "[" + all + "]";
}

/// A key of scene files, all its parts, with its value.
struct Change {
  std::string key;
  const Node* value;
};

/// The keys of a table and of tables in it.
void collect(const Node::Table& table, const std::string& before, std::vector<Change>& settings) {
  for (const Entry& entry : table) {
    const std::string key = before + entry.key;
    if (const Node::Table* inside = entry.node.table())
      collect(*inside, key + ".", settings);
    else
      settings.push_back({key, &entry.node});
  }
}
std::vector<Change> settings_in(TableReader& reader, const std::string& key) {
  std::vector<Change> settings;
  const Node* node = reader.find(key);
  if (!node) return settings;
  if (!node->table()) reader.fail(key, "'" + key + "' must be a table of settings, not " + kind_of(*node));
  collect(*node->table(), "", settings);
  return settings;
}

std::vector<std::string> read_settings(TableReader& reader, const std::string& key) {
  std::vector<std::string> options;
  for (const Change& setting : settings_in(reader, key))
    options.push_back(setting.key + "=" + toml_text(*setting.value));
  return components_first(std::move(options));
}

/// The table `reference`, of what it does not say as `otherwise` says.
RenderedReference read_rendered(TableReader& root, const std::string& title, RenderedReference otherwise) {
  std::optional<TableReader> table = root.table("reference", title);
  if (!table) return otherwise;
  otherwise.error = table->number("error", kPositive, static_cast<float>(otherwise.error));
  if (table->has("set")) otherwise.settings = read_settings(*table, "set");
  table->finish();
  return otherwise;
}

/// Where the reference comes from: a word, a file, or a table that says how it is rendered.
void read_source(TableReader& table, ComparedScene& scene, const RenderedReference& otherwise) {
  const Node* node = table.find("reference");
  if (!node || node->table()) {
    scene.rendered = read_rendered(table, "[scenes.reference]", otherwise);
  } else if (table.string("reference") == "exact") {
    scene.source = ReferenceSource::exact;
  } else {
    scene.source = ReferenceSource::file;
    scene.reference_file = table.path("reference");
  }
}

std::vector<ComparedScene> read_scenes(TableReader& root, const RenderedReference& reference) {
  std::vector<ComparedScene> scenes;
  std::set<std::string> names;
  for (TableReader& table : root.tables("scenes", "[[scenes]]")) {
    ComparedScene scene;
    scene.name = table.string("name");
    if (!names.insert(scene.name).second) table.fail("name", "two scenes are named '" + scene.name + "'");
    scene.file = table.path("file");
    read_source(table, scene, reference);
    scene.settings = read_settings(table, "set");
    scene.place = text_of(table.place());
    table.finish();
    scenes.push_back(std::move(scene));
  }
  if (scenes.empty()) root.fail_here("the experiment has no scene", "add [[scenes]] with a name and a file");
  return scenes;
}

/// A value in a method's name: words without quotes.
std::string short_text(const Node& node) {
  const auto* word = std::get_if<std::string>(&node.value);
  return word ? *word : toml_text(node);
}

/// Every combination of the values that [product] lists, the last key's changing fastest.
std::vector<Method> read_product(TableReader& root) {
  constexpr size_t kMostMethods = 1000;  // products grow soon beyond all memory
  const std::vector<Change> settings = settings_in(root, "product");
  std::vector<Method> methods{{.name = "", .settings = {}, .place = text_of(root.place_of("product"))}};
  for (const Change& setting : settings) {
    const Node::Array* values = setting.value->array();
    if (!values || values->empty())
      fail_at(setting.value->place, "'" + setting.key + "' of [product] must be an array of values",
              "write " + setting.key + " = [..., ...]");
    if (methods.size() * values->size() > kMostMethods)
      fail_at(setting.value->place, fmt::format("[product] makes more than {} methods", kMostMethods),
              "list fewer values, or fewer keys");
    std::vector<Method> combined;
    for (const Method& method : methods)
      for (const Node& value : *values) {
        Method next = method;
        next.name += (next.name.empty() ? "" : " ") + short_text(value);
        next.settings.push_back(setting.key + "=" + toml_text(value));
        combined.push_back(std::move(next));
      }
    methods = std::move(combined);
  }
  return settings.empty() ? std::vector<Method>{} : methods;
}

std::vector<Method> read_methods(TableReader& root) {
  const std::vector<std::string> common = read_settings(root, "set");
  std::vector<Method> methods = read_product(root);
  for (TableReader& table : root.tables("methods", "[[methods]]")) {
    methods.push_back({table.string("name"), read_settings(table, "set"), text_of(table.place())});
    table.finish();
  }
  if (methods.size() < 2)
    root.fail_here("the experiment compares nothing", "add two [[methods]], or a [product] of settings");
  std::set<std::string> names;
  for (Method& method : methods) {
    if (!names.insert(method.name).second) root.fail_here("two methods are named '" + method.name + "'");
    method.settings = components_first(std::move(method.settings));
    method.settings.insert(method.settings.begin(), common.begin(), common.end());
  }
  return methods;
}

/// The method that `baseline` names.
std::optional<size_t> read_baseline(TableReader& root, const std::vector<Method>& methods) {
  if (!root.has("baseline")) return std::nullopt;
  const std::string name = root.string("baseline");
  std::vector<std::string> names;
  for (const Method& method : methods) names.push_back(method.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    root.fail("baseline", "there is no method '" + name + "'", suggest(name, names, "there are"));
  return static_cast<size_t>(found - names.begin());
}

void read_budgets(TableReader& root, ComparisonPlan& plan) {
  plan.unit = root.choice<CostUnit>("unit",
                                    {{"seconds", CostUnit::seconds},
                                     {"passes", CostUnit::passes},
                                     {"photons", CostUnit::photons},
                                     {"lookups", CostUnit::lookups}},
                                    CostUnit::seconds);
  const Node& budgets = root.require("budgets");
  plan.budgets = root.numbers("budgets", budgets.array() ? budgets.array()->size() : 1, kPositive);
  if (plan.budgets.empty()) root.fail("budgets", "there is no budget");
  for (size_t i = 1; i < plan.budgets.size(); ++i)
    if (!(plan.budgets[i] > plan.budgets[i - 1])) root.fail("budgets", "budgets must rise");
}

/// [reference] is for scenes without a file.
void check_reference(TableReader& root, const std::vector<ComparedScene>& scenes) {
  const auto is_rendered = [](const ComparedScene& scene) { return scene.source == ReferenceSource::rendered; };
  if (root.has("reference") && std::none_of(scenes.begin(), scenes.end(), is_rendered))
    root.fail("reference", "no reference is rendered: every scene names its own", "leave out [reference]");
}

}  // namespace

ComparisonPlan load_comparison_plan(const std::string& path, const std::vector<std::string>& overrides) {
  Document document = read_toml(path);
  for (const std::string& option : overrides) apply_override(document, option);
  std::vector<std::string> files;
  TableReader root(document.root, "the experiment", files);
  ComparisonPlan plan;
  plan.text = document.text;
  plan.title = root.string("title");
  read_budgets(root, plan);
  plan.repetitions = static_cast<int>(root.integer("repetitions", 3, 10'000, 10));
  plan.seed = root.integer("seed", 0, uint64_t{1} << 62, 1);
  plan.scenes = read_scenes(root, read_rendered(root, "[reference]", {}));
  check_reference(root, plan.scenes);
  plan.methods = read_methods(root);
  plan.baseline = read_baseline(root, plan.methods);
  root.finish();
  return plan;
}

}  // namespace vpm
