#include <algorithm>
#include <deque>
#include <map>
#include <set>

#include "tests/house/house_rules.hpp"
#include "tests/house/source_tree.hpp"

namespace arcstart::test {
namespace {

using Graph = std::map<std::string, std::set<std::string>>;  // component to those it includes

std::string component_of(const std::string& path) { return path.substr(0, path.rfind('.')); }

Graph components(const std::filesystem::path& root) {
  Graph graph;
  for (const SourceFile& file : sources_below(root, {"common", "services"})) {
    const std::string component = component_of(file.path);
    auto& used = graph[component];
    for (const Include& include : file.includes)
      if (component_of(include.target) != component) used.insert(component_of(include.target));
  }
  return graph;
}

// The shortest way from a component back to itself, both ends included; empty where there is none.
std::vector<std::string> way_back(const Graph& graph, const std::string& start) {
  std::map<std::string, std::string> came_from;
  std::deque<std::string> open{start};
  while (!open.empty()) {
    const std::string here = open.front();
    open.pop_front();
    const auto used = graph.find(here);
    if (used == graph.end()) continue;
    for (const std::string& next : used->second) {
      if (next == start) {
        std::vector<std::string> way{start};
        for (std::string at = here; at != start; at = came_from.at(at)) way.push_back(at);
        way.push_back(start);
        std::reverse(way.begin(), way.end());
        return way;
      }
      if (came_from.emplace(next, here).second) open.push_back(next);
    }
  }
  return {};
}

}  // namespace

std::vector<std::string> circles(const std::filesystem::path& root) {
  const Graph graph = components(root);
  std::vector<std::string> lines;
  std::set<std::string> reported;
  for (const auto& [component, used] : graph) {
    if (reported.contains(component)) continue;
    const auto way = way_back(graph, component);
    if (way.empty()) continue;
    std::string line;
    for (const std::string& step : way) line += (line.empty() ? "" : " -> ") + step;
    lines.push_back(line);
    reported.insert(way.begin(), way.end());
  }
  return lines;
}

}  // namespace arcstart::test
