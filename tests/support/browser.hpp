#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temporary_directory.hpp"

// Pages as a browser shows them.
namespace tanglebin::test {

inline bool has_browser() {
  return std::system("command -v chromium >/dev/null") == 0;
}

/// Opens a page in a window of this width and appends a script to it. Returns the JSON text that the script
/// gives to parent.postMessage(). (A browser's own window cannot be as small as a phone's: the page is in a
/// frame.) Without a message, the calling test fails.
inline nlohmann::json told_by_page(const std::string& page, const std::string& script, int width) {
  const TemporaryDirectory directory;
  write_bytes(directory / "page.html", page + "<script>" + script + "</script>");
  write_bytes(
      directory / "frame.html",
      "<!DOCTYPE html>\n<iframe src=\"page.html\" width=\"" + std::to_string(width) +
          "\" height=\"800\" style=\"border: 0\"></iframe>\n<script>\n"
          "addEventListener(\"message\", event => { document.body.textContent = \"TOLD\" + event.data "
          "+ \"END\"; });\n</script>");
  const std::string command =
      "timeout 240 chromium --headless --no-sandbox --hide-scrollbars --disable-dev-shm-usage "
      "--use-angle=swiftshader --enable-unsafe-swiftshader --window-size=1400,900 --user-data-dir=" +
      (directory / "profile").string() + " --virtual-time-budget=20000 --dump-dom file://" +
      (directory / "frame.html").string() + " >" + (directory / "dom").string() + " 2>" +
      (directory / "err").string();
  const int status = std::system(command.c_str());
  const std::string dom = bytes_of(directory / "dom");
  const std::size_t begin = dom.find("TOLD{");
  const std::size_t end = dom.find("}END");
  if (begin == std::string::npos || end == std::string::npos) {
    ADD_FAILURE() << "chromium, status " << status << ", gave\n" << dom << bytes_of(directory / "err");
    return {};
  }
  return nlohmann::json::parse(dom.substr(begin + 4, end + 1 - begin - 4));
}

}  // namespace tanglebin::test
