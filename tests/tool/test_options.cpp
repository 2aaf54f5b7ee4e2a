// SPDX-License-Identifier: BSD-3-Clause
// What the command line accepts, and that a refusal names the option, its value and what is allowed.
#include "run_tool.h"

#include <pcl_gpf/version.h>

#include <gtest/gtest.h>

namespace pcl_gpf::test {
namespace {

void
expectUsageError(const std::vector<std::string>& words, const std::vector<std::string>& mentions)
{
  const ToolRun run = runTool(words);
  std::string line;
  for (std::size_t i = 0; i < words.size() && i < 8; ++i)
    line += words[i] + " ";
  SCOPED_TRACE(line);
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_EQ(run.out, "");
  for (const std::string& mention : mentions)
    EXPECT_NE(run.err.find(mention), std::string::npos) << run.err << "lacks " << mention;
}

TEST(ToolOptions, HelpGoesToStandardOutputAndBeginsWithThreeExamples)
{
  for (const char* command : {"info", "filter", "normals", "orient", "upsample", "convert", "compare", "noise", "render"}) {
    const ToolRun run = runTool({command, "--help"});
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.err, "");
    const std::string example = std::string("  pcl_gpf_tool ");
    std::size_t place = run.out.find("Examples:\n");
    ASSERT_EQ(place, 0u) << command;
    for (int i = 0; i < 3; ++i) {
      place = run.out.find('\n', place) + 1;
      EXPECT_EQ(run.out.compare(place, example.size(), example), 0) << run.out.substr(place, 60);
    }
    EXPECT_EQ(runTool({"help", command}).out, run.out);
    EXPECT_EQ(runTool({command, "-h"}).out, run.out);
  }
}

TEST(ToolOptions, WithoutArgumentsHelpGoesToStandardErrorWithExitCode2)
{
  const ToolRun run = runTool({});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("Usage: pcl_gpf_tool"), std::string::npos);
}

TEST(ToolOptions, VersionIsThatOfTheLibrary)
{
  EXPECT_EQ(runTool({"--version"}).out, "pcl_gpf_tool " PCL_GPF_VERSION "\n");
}

TEST(ToolOptions, MisspellingsAreAnsweredWithTheRightSpelling)
{
  expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--raduis", "1"}, {"--raduis", "'--radius'"});
  expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "-radius", "1"}, {"-radius", "'--radius'", "two dashes"});
  expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--iteration=3"}, {"'--iterations'"});
  expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--bilateral_angle=3"}, {"'--bilateral-angle'"});
  expectUsageError({"fliter", "in.pcd"}, {"fliter", "'filter'"});
  expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--preset", "papre"}, {"--preset", "papre", "'paper'", "default | freeform | prismatic | paper"});
}

TEST(ToolOptions, AbbreviationsAreNotGuessed)
{
  expectUsageError({"filter", "in.pcd", "--out", "out.pcd"}, {"--out", "'--output'"});
  expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--iter", "3"}, {"--iter"});
}

TEST(ToolOptions, BadLengthsAreRefusedWithTheRange)
{
  for (const char* value : {"0", "-1", "nan", "inf", "-inf", "1e308", "1e-308", "", "abc", "1,5", "1.5y", "x", "%", "1 ", " 1", "0x1p3",
                            "1e999", "4xx", "-4x", "0%"})
    expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--radius", value}, {"--radius", "> 0", "4x"});
}

TEST(ToolOptions, BadNumbersAreRefusedWithTheRange)
{
  for (const char* value : {"-1", "nan", "inf", "1e308", "", "abc", "0,1", "0.1x", "0.51"})
    expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--repulsion", value}, {"--repulsion", "0 .. 0.5"});
  for (const char* value : {"0", "-5", "90.1", "nan"})
    expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--normal-angle", value}, {"--normal-angle", "> 0 and <= 90"});
  for (const char* value : {"1", "-0.1", "2"})
    expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--outlier-weight", value}, {"--outlier-weight", ">= 0 and < 1"});
  for (const char* value : {"-1", "10001", "2147483648", "9223372036854775808", "1.5", "abc", "99999999999999999999999"})
    expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--iterations", value}, {"--iterations", "0 .. 10000"});
  for (const char* value : {"-1", "1000000", "2147483648", "abc"})
    expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--threads", value}, {"--threads", "0 .. 1024"});
  for (const char* value : {"0", "0%", "100.1%", "-5%", "1.5", "half", "nan%"})
    expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--samples", value}, {"--samples", "100%"});
  for (const char* value : {"1", "1,2", "1,2,3,4", "a,b,c", "1,2,", "nan,0,0"})
    expectUsageError({"convert", "in.pcd", "-o", "out.pcd", "--offset", value}, {"--offset", "three numbers"});
}

TEST(ToolOptions, MissingValuesRepetitionsAndSurplusFilesAreRefused)
{
  expectUsageError({"filter", "in.pcd", "-o"}, {"--output", "needs a value"});
  expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--radius"}, {"--radius", "needs a value"});
  expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--radius="}, {"--radius", "needs a value"});
  expectUsageError({"filter", "in.pcd", "--output", "--overwrite"}, {"--output", "needs a value"});
  expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--overwrite=yes"}, {"--overwrite", "takes no value"});
  expectUsageError({"filter", "in.pcd", "-o", "a.pcd", "-o", "b.pcd"}, {"--output", "twice"});
  expectUsageError({"filter", "in.pcd", "-o", "a.pcd", "-q", "--quiet"}, {"--quiet", "twice"});
  expectUsageError({"filter", "in.pcd", "second.pcd", "-o", "a.pcd"}, {"second.pcd"});
  expectUsageError({"filter", "in.pcd"}, {"-o FILE"});
  expectUsageError({"filter", "-o", "a.pcd"}, {"no input file"});
  expectUsageError({"info"}, {"no input file"});
}

TEST(ToolOptions, TenThousandArgumentsAreRefused)
{
  std::vector<std::string> words{"filter"};
  words.resize(10000, "--radius=1");
  expectUsageError(words, {"--radius", "twice"});
  std::vector<std::string> files{"filter"};
  files.resize(10000, "a.pcd");
  expectUsageError(files, {"one file too many"});
}

TEST(ToolOptions, CloudAndReportCannotShareOneTarget)
{
  expectUsageError({"filter", "in.pcd", "-o", "-", "--json"}, {"--json=FILE"});
  expectUsageError({"filter", "in.pcd", "-o", "out.pcd", "--json=in.pcd", "--overwrite"}, {"in.pcd", "--json=FILE"});
}

TEST(ToolOptions, TheTablesOfTheDocumentationAreThoseOfTheTool)
{
  const std::string page = readBytes(std::string(PCL_GPF_SOURCE_DIR) + "/docs/tool.md");
  const std::string tables = runTool({"--markdown"}).out;
  ASSERT_FALSE(tables.empty());
  std::size_t begin = 0;
  while (begin < tables.size()) {
    const std::size_t end = tables.find('\n', begin);
    const std::string line = tables.substr(begin, end - begin);
    EXPECT_NE(page.find(line + "\n"), std::string::npos) << "docs/tool.md lacks: " << line << "\nreplace the part behind '## Options' by the output of pcl_gpf_tool --markdown";
    begin = end + 1;
  }
}

} // namespace
} // namespace pcl_gpf::test
