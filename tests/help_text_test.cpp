// Help texts, the words of the command line that are no options, and --quiet.
#include <gtest/gtest.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/command_line.hpp"
#include "pelagic/tools/text/help_formatter.hpp"

namespace pelagic {
namespace {

bool contains(const std::vector<std::string>& lines, const std::string& line) {
    return std::ranges::find(lines, line) != lines.end();
}

TEST(HelpText, ListsEveryOptionOnceInAtMost100Columns) {
    tools::describe_command_line([](const CLI::App& app) {
        for (const CLI::App* command : app.get_subcommands({})) {
            const Outcome outcome = run_pelagic({command->get_name(), "--help"});
            ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
            const std::vector<std::string> lines = lines_of(outcome.out);
            for (const std::string& line : lines) EXPECT_LE(line.size(), 100u) << line;
            for (const CLI::Option* option : command->get_options()) {
                if (option->get_lnames().empty()) continue;
                const std::string name = "--" + option->get_lnames().front();
                const auto describes = [&](const std::string& line) {
                    return line.starts_with("  ") && (line.substr(2).starts_with(name + " ") || line == "  " + name ||
                                                      line.find(", " + name + " ") == 4);
                };
                EXPECT_EQ(std::ranges::count_if(lines, describes), 1) << command->get_name() << " " << name;
            }
        }
    });
}

// A new user reads these at a glance.
TEST(HelpText, DescribesTheCommonOptionsOnOneLine) {
    const std::vector<std::string> lines = lines_of(run_pelagic({"export", "--help"}).out);
    for (const char* const option :
         {"  -o, --out DIR", "  --frames NUMBERS", "  --fps NUMBER", "  --half", "  --unit m|cm",
          "  --wind-speed SPEED", "  --wind-direction HEADING", "  --fetch NUMBER", "  --depth NUMBER",
          "  --choppiness NUMBER", "  --loop-period NUMBER", "  --seed NUMBER", "  --swell-direction HEADING",
          "  --threads NUMBER"}) {
        const auto line =
            std::ranges::find_if(lines, [&](const std::string& one) { return one.starts_with(option); });
        ASSERT_NE(line, lines.end()) << option;
        EXPECT_GT(line->size(), 30u) << "no description: " << *line;
        EXPECT_TRUE(line + 1 == lines.end() || (line + 1)->empty() || (line + 1)->starts_with("  -")) << *(line + 1);
    }
    for (const char* const heading : {"Output:", "Sea:", "Swell:", "Analytic waves:", "Dynamic waves:",
                                      "Performance (results are bit-identical for all values):"})
        EXPECT_TRUE(contains(lines, heading)) << heading;
}

TEST(CommandLine, FirstWordIsThePresetOrTheOutput) {
    EXPECT_EQ(run_pelagic({"info", "storm", "--json"}).out, run_pelagic({"info", "--preset", "storm", "--json"}).out);
    const TemporaryFolder folder;
    for (const std::vector<std::string>& output :
         {std::vector<std::string>{"word"}, {"-o", "letter"}, {"--out", "name"}}) {
        const Outcome outcome = run_pelagic(joined({"export", "--resolution", "16", "--quiet"}, output),
                                            [&] { std::filesystem::current_path(folder.path()); });
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.out + outcome.err, "");
        EXPECT_EQ(files_in(folder / output.back()), files_in(folder / "word"));
    }
    for (const auto& [command, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"info", "strom"}, "--preset is strom, expected pond"},
             {{"info", "storm", "--preset", "calm"}, "--preset is given 2 times; give it once"},
             {{"export", "a", "--out", "b"}, "--out is given 2 times; give it once"},
             {{"export", "a", "b"}, "unexpected word b; pelagic export --help lists all"},
             {{"export", "--wind-speed", "--seed", "3"}, "--wind-speed requires a value"}}) {
        const Outcome outcome = run_pelagic(command);
        EXPECT_EQ(outcome.exit_code, 2) << says;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err << "lacks " << says;
    }
}

// A sea of 250 m repeats within 300 m of points, which is a note; an error is printed even so.
TEST(CommandLine, QuietPrintsResultsAndErrorsOnly) {
    const TemporaryFolder folder;
    write_file(folder / "points.csv", "0,0\n300,0\n");
    const std::vector<std::string> query = {"query", "--points", (folder / "points.csv").string(), "--patch-size",
                                            "250"};
    std::vector<std::string> quiet_query = query;
    quiet_query.push_back("-q");
    const Outcome usual = run_pelagic(query), quiet = run_pelagic(quiet_query);
    EXPECT_NE(usual.err.find("note: the points span 300 m"), std::string::npos) << usual.err;
    EXPECT_EQ(quiet.err, "");
    EXPECT_EQ(quiet.out, usual.out);
    const Outcome error = run_pelagic({"query", "--quiet"});
    EXPECT_EQ(error.exit_code, 2);
    EXPECT_NE(error.err, "");
}

}  // namespace
}  // namespace pelagic
