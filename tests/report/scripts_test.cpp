// The pages' scripts as Node.js reads them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace tanglebin {
namespace {

TEST(Scripts, AreJavaScript) {
  if (std::system("command -v node >/dev/null") != 0) GTEST_SKIP() << "node is not installed";
  const std::filesystem::path directory = std::filesystem::path(TANGLEBIN_SOURCE) / "tanglebin/report/page";
  int scripts = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() != ".js") continue;
    ++scripts;
    EXPECT_EQ(std::system(("node --check " + entry.path().string()).c_str()), 0) << entry.path();
  }
  EXPECT_GT(scripts, 0);
}

}  // namespace
}  // namespace tanglebin
