#include "common/files/config_document.hpp"

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.hpp"

namespace lifeline::files {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHowToUpdate =
    "out of date; run: cmake --build BUILD --target update_config_documents";

TEST(ConfigDocuments, CommittedFilesAreUpToDate) {
  const auto documents = make_config_documents(LIFELINE_CONFIG_DESCRIPTORS);
  ASSERT_TRUE(documents) << documents.error().text;
  const std::filesystem::path project(LIFELINE_SOURCE_DIR);
  EXPECT_EQ(support::content_of(project / "docs/parameters.md"), documents->parameters_md)
      << kHowToUpdate;
  EXPECT_EQ(support::content_of(project / "config/agent.yaml"), documents->agent_yaml)
      << kHowToUpdate;
  EXPECT_EQ(support::content_of(project / "config/coordinator.yaml"), documents->coordinator_yaml)
      << kHowToUpdate;
}

TEST(ConfigDocuments, NameEveryKeyWithDefaultLimitsAndMeaning) {
  const auto documents = make_config_documents(LIFELINE_CONFIG_DESCRIPTORS);
  ASSERT_TRUE(documents);
  EXPECT_THAT(documents->parameters_md,
              HasSubstr("| `slam.gicp_max_iterations` | `100` | a whole number from 1 to 1000 | "
                        "Most iterations of GICP (the paper: 100). |"));
  EXPECT_THAT(documents->agent_yaml, HasSubstr("  gicp_max_iterations: 100\n"));
}

TEST(ConfigDocuments, AFileThatIsNoDescriptorSetIsNamed) {
  const support::TemporaryFolder folder;
  const auto documents = make_config_documents(folder.write("x.descriptors", "no such thing"));
  ASSERT_FALSE(documents);
  EXPECT_THAT(documents.error().text, HasSubstr("x.descriptors: not the descriptors"));
}

}  // namespace
}  // namespace lifeline::files
