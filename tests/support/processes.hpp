#pragma once

#include <sys/types.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace tanglebin::test {

/// Whether a process is there and not a zombie, as proc(5) tells.
inline bool is_running(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(stat, text);
  const std::size_t state = text.rfind(')') + 2;  // the name before it may have anything in it
  return state < text.size() && text[state] != 'Z' && text[state] != 'X';
}

/// The processes that it has forked.
inline std::vector<pid_t> children_of(pid_t process) {
  const std::string name = std::to_string(process);
  std::ifstream list("/proc/" + name + "/task/" + name + "/children");
  std::vector<pid_t> children;
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

}  // namespace tanglebin::test
