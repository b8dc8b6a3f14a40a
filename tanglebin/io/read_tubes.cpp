#include "tanglebin/io/read_tubes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <fstream>
#include <istream>
#include <set>
#include <string_view>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/configuration.hpp"

namespace tanglebin {
namespace {

constexpr std::uint64_t tubes_format = 1;

void expect_text(const JsonRecord& record, const std::string& field, std::string_view expected) {
  if (const std::string found = record.text(field); found != expected)
    record.fail(field, excerpt(found), excerpt(expected));
}

// The lists in a list, each of so many numbers.
std::vector<Json> lists_in(const JsonRecord& record, const std::string& field, std::size_t size,
                           const std::string& expected) {
  if (!record.has(field) || !record.json().at(field).is_array()) record.fail(field, "no list", "a list");
  std::vector<Json> lists;
  for (const Json& item : record.json().at(field)) {
    const bool is_list = item.is_array() && item.size() == size &&
                         std::ranges::all_of(item, [](const Json& number) { return number.is_number(); });
    if (!is_list) record.fail(fmt::format("{}[{}]", field, lists.size()), excerpt(item.dump()), expected);
    lists.push_back(item);
  }
  return lists;
}

void read_nodes(const JsonRecord& record, Tube& tube) {
  for (const Json& node : lists_in(record, "nodes", 3, "a position: three numbers")) {
    const int id = static_cast<int>(tube.nodes.size()) + 1;
    tube.nodes.push_back({id, {node[0].get<double>(), node[1].get<double>(), node[2].get<double>()}});
  }
  if (tube.nodes.size() < 2) record.fail("nodes", fmt::format("{}", tube.nodes.size()), "at least 2");
}

std::size_t index_of(const Json& number, std::size_t nodes, const JsonRecord& record) {
  if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= nodes)
    record.fail("edges", excerpt(number.dump()), fmt::format("the index of a node, 0 to {}", nodes - 1));
  return number.get<std::size_t>();
}

void read_edges(const JsonRecord& record, Tube& tube) {
  boost::disjoint_sets_with_storage<> components(tube.nodes.size());
  for (const Json& edge : lists_in(record, "edges", 2, "two indices of nodes")) {
    const std::size_t from = index_of(edge[0], tube.nodes.size(), record);
    const std::size_t to = index_of(edge[1], tube.nodes.size(), record);
    if (components.find_set(from) == components.find_set(to))
      record.fail("edges", edge.dump() + ", which closes a loop", "edges that form a tree");
    components.union_set(from, to);
    tube.edges.push_back({.from = from, .to = to, .order = static_cast<int>(tube.edges.size()) + 1});
  }
  if (tube.edges.size() + 1 != tube.nodes.size())
    record.fail("edges", fmt::format("{}", tube.edges.size()),
                fmt::format("{}, one less than the tree's nodes", tube.nodes.size() - 1));
}

Tube tube_of(const JsonRecord& record) {
  Tube tube{.id = record.positive_int("id"), .radius = record.number("radius"), .nodes = {}, .edges = {}};
  if (!(tube.radius > 0)) record.fail("radius", fmt::format("{}", tube.radius), "a positive number");
  const std::string ends = record.text("ends");
  if (ends != "round" && ends != "flat") record.fail("ends", excerpt(ends), "\"round\" or \"flat\"");
  tube.flat_ends = ends == "flat";
  read_nodes(record, tube);
  read_edges(record, tube);
  return tube;
}

std::vector<Tube> tubes_of(const JsonRecord& record) {
  if (const std::uint64_t found = record.whole_number("format"); found != tubes_format)
    record.fail("format", fmt::format("{}", found), fmt::format("{}", tubes_format));
  expect_text(record, "frame", "world");
  expect_text(record, "unit", "m");
  std::vector<Tube> tubes;
  std::set<int> ids;
  for (const JsonRecord& its : record.objects("tubes")) {
    tubes.push_back(tube_of(its));
    if (!ids.insert(tubes.back().id).second)
      its.fail("id", fmt::format("{} twice", tubes.back().id), "distinct ids");
  }
  return tubes;
}

}  // namespace

std::vector<Tube> read_tubes(std::istream& in, const std::string& name) {
  if (in.peek() != '{') return read_configuration(in, name);
  return tubes_of({read_bytes(in, name), name, 0});
}

std::vector<Tube> read_tubes(const std::filesystem::path& file) {
  std::ifstream in = open_input(file);
  return read_tubes(in, file.string());
}

}  // namespace tanglebin
