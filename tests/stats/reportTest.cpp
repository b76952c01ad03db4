// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "report.h"

#include <gtest/gtest.h>

#include <stats/table.h>
#include <support/error.h>

#include "study_folder.h"

namespace {

using namespace std::string_literals;

const std::string smallest_png_end = "\0\0\0\0IEND\xae\x42\x60\x82"s;

std::string report_of(const StudyFolder& folder, const std::optional<std::string>& picture = {}) {
    const auto analysis = stats::analyse_study(folder.path());
    const std::string svg = "<?xml?><svg>figure</svg>";
    return report_html(analysis, {svg, svg, svg, {analysis.rows.size(), std::nullopt}, picture});
}

int count_of(const std::string& part, const std::string& text) {
    int count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

// [Josefsson2006, section 10]
TEST(ReportTest, base64HasReferenceValues) {
    EXPECT_EQ(stats::base64(""), "");
    EXPECT_EQ(stats::base64("f"), "Zg==");
    EXPECT_EQ(stats::base64("fo"), "Zm8=");
    EXPECT_EQ(stats::base64("foo"), "Zm9v");
    EXPECT_EQ(stats::base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(stats::base64("\xff\xfe\x00"s), "//4A");
}

TEST(ReportTest, hostileTextIsEscaped) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rt"));
    folder.write("dataset_description.json", R"({"Name": "<script>alert('x')</script> \"&\" \u001b[1m"})");
    const std::string html = report_of(folder);
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_EQ(html.find('\x1b'), std::string::npos);
    EXPECT_NE(html.find("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt; &quot;&amp;&quot;"),
              std::string::npos);
}

TEST(ReportTest, isOneSelfContainedPage) {
    const StudyFolder folder;
    folder.write_published_logs();
    const std::string html = report_of(folder, "picture"s);
    EXPECT_EQ(html.find("<?xml"), std::string::npos);
    EXPECT_NE(html.find("<svg>figure</svg>"), std::string::npos);
    EXPECT_NE(html.find("src=\"data:image/png;base64,cGljdHVyZQ==\""), std::string::npos);
    for (const char* outside : {"src=\"h", "src=\"/", "href=", "url(", "@import", "<link", "<script"}) {
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
    }
    EXPECT_LT(html.find("As the paper tests, SS Full shows no significant difference"),
              html.find("<table")); // the answer comes first
}

TEST(ReportTest, oneIsNotPlural) {
    const StudyFolder folder;
    folder.write_log("01", log_text("r"));
    const std::string html = report_of(folder);
    EXPECT_NE(html.find("1 participant, 1 answer, 1 condition."), std::string::npos);
    EXPECT_NE(html.find("the only condition, and the only row of"), std::string::npos);
    for (const char* wrong :
         {"1 participants", "1 conditions", " 1 rows", "1 runs", "1 logs", "choice answers in 1"}) {
        EXPECT_EQ(html.find(wrong), std::string::npos) << wrong;
    }
}

TEST(ReportTest, narrowScreensAreToldToScroll) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rt"));
    EXPECT_NE(report_of(folder).find("content: \"Scroll sideways"), std::string::npos);
}

TEST(ReportTest, everyTableScrollsRatherThanBeingCutOff) {
    const StudyFolder folder;
    folder.write_published_logs();
    const std::string html = report_of(folder);
    EXPECT_NE(html.find(".scroll, .card { overflow-x: auto; }"), std::string::npos);
    EXPECT_EQ(count_of("<table", html), count_of("<div class=\"scroll\"><table", html));
    // A long verdict and a long name are broken into lines, so that their columns are no wider than they must
    // be.
    EXPECT_NE(html.find(".details td:nth-child(2) { white-space: normal;"), std::string::npos);
}

TEST(ReportTest, marksTheNonSignificantCells) {
    // Table II has 36 cells, of which the paper sets 11 p-values (and their chi-values) in bold.
    const StudyFolder folder;
    folder.write_published_logs();
    const std::string html = report_of(folder);
    const std::string table = html.substr(html.find("<table class=\"table2\">"));
    const std::string first = table.substr(0, table.find("</table>"));
    EXPECT_EQ(count_of("class=\"alike\"", first), 22);
    EXPECT_EQ(count_of("&nbsp;*</td>", first), 11);
    EXPECT_NE(first.find("<td>4.5</td><td>0.034</td>"), std::string::npos);
}

TEST(ReportTest, tellsWhatWasLeftOut) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rtn"));
    folder.write_log("02", log_text("rt") + "3\tts");
    folder.write_log("03", log_text("r"));
    folder.write_log("03", log_text("rtr"), "_run-02");
    fs::create_directories(folder.path() / "sub-04");
    const std::string html = report_of(folder);
    for (const char* part :
         {"1 of 8 trials without an answer",
          "sub-02_task-skin2afc_beh.tsv: counted though incomplete: 2 of 3 trials",
          "line 4 set aside: no line break at its end",
          "sub-03_task-skin2afc_beh.tsv: not counted: incomplete, 1 of 3 trials; run 2 counts",
          "sub-04: no log", "holds no pictures of the stimuli"}) {
        EXPECT_NE(html.find(part), std::string::npos) << part;
    }
}

TEST(ReportTest, simulatedDataCarryABanner) {
    const StudyFolder real, simulated;
    real.write_log("01", log_text("rt"));
    EXPECT_EQ(report_of(real).find("SIMULATED"), std::string::npos);
    simulated.write_log("01", log_text("rt"));
    simulated.write("dataset_description.json", R"({"Simulated": true})");
    const std::string html = report_of(simulated);
    EXPECT_NE(html.find("<div class=\"banner\" role=\"alert\">SIMULATED DATA"), std::string::npos);
    EXPECT_NE(html.find("<figcaption>SIMULATED DATA"), std::string::npos);
}

TEST(ReportTest, onlyWholePngsAreShown) {
    const StudyFolder folder;
    EXPECT_FALSE(stats::read_png(folder.path() / "missing.png"));
    const std::string whole = "\x89PNG\r\n\x1a\n...."s + smallest_png_end;
    EXPECT_EQ(stats::read_png(folder.write("whole.png", whole)), whole);
    for (const std::string& text : {""s, "hello"s, whole.substr(0, whole.size() - 1), whole.substr(1)}) {
        const auto file = folder.write("bad.png", text);
        EXPECT_NE(
            message_of<support::InputError>([&] { stats::read_png(file); }).find("expected a whole PNG"),
            std::string::npos);
    }
}

TEST(ReportTest, theAnswerStandsFirstAndDisagreementsNext) {
    const StudyFolder folder;
    int participant = 0;
    for (const std::size_t k : {17u, 4u, 15u, 6u, 18u, 9u, 16u, 5u, 14u, 12u}) {
        folder.write_log(fmt::format("{:02}", ++participant),
                         log_text(std::string(k, 'r') + std::string(18 - k, 't')));
    }
    const std::string html = report_of(folder);
    const auto warning = html.find("<ul class=\"warning\">");
    ASSERT_NE(warning, std::string::npos);
    EXPECT_LT(html.find("<ul class=\"answer\">"), warning);
    EXPECT_LT(warning, html.find("As the paper tests"));
    EXPECT_LT(html.find("disagree on SS Full"), html.find("<h2>"));
}

TEST(ReportTest, hasEverySectionAndNamesEveryTest) {
    const StudyFolder folder;
    folder.write_published_logs();
    const std::string html = report_of(folder);
    std::size_t last = 0;
    for (const char* heading : {"Table II", "Figure 8", "Shaders", "Stimuli", "Every condition", "Order",
                                "Expertise", "Response times", "Data quality", "Methods"}) {
        const auto at = html.find("<h2>"s + heading);
        ASSERT_NE(at, std::string::npos) << heading;
        EXPECT_GT(at, last);
        last = at;
    }
    const std::string methods = html.substr(last);
    for (const char* part : {"chi-square",    "exact two-sided binomial",
                             "Wilson",        "Clopper",
                             "Cohen",         "Holm",
                             "Benjamini",     "sign-flip",
                             "t-test",        "mixed model",
                             "101 points",    "observed information",
                             "equal mixture", "two one-sided",
                             "0.35 and 0.65", "Beta(1, 1)",
                             "rank-sum",      "Welch",
                             "skin2afc 0.",   "Boost.Math 1."}) {
        EXPECT_NE(methods.find(part), std::string::npos) << part;
    }
}

TEST(ReportTest, inlineFiguresHaveIdsOfTheirOwn) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rt"));
    const auto analysis = stats::analyse_study(folder.path());
    const std::string svg =
        "<svg><g id=\"gnuplot_plot_1\"/><circle id='gpPt1'/><use xlink:href='#gpPt1'/></svg>";
    const std::string html = report_html(analysis, {svg, svg, svg, {std::nullopt}, std::nullopt});
    EXPECT_EQ(count_of("id=\"agnuplot_plot_1\"", html), 1);
    EXPECT_EQ(count_of("id='bgpPt1'", html), 1);
    EXPECT_EQ(count_of("'#cgpPt1'", html), 1);
    EXPECT_EQ(count_of("\"gnuplot_plot_1\"", html), 0);
}

TEST(ReportTest, badFilesAreListed) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rt"));
    folder.write_log("02", "");
    const auto analysis = stats::analyse_study(folder.path(), {}, {true, false});
    const std::string svg = "<svg></svg>",
                      html = report_html(analysis, {svg, svg, svg, {std::nullopt}, std::nullopt});
    EXPECT_NE(html.find("sub-02/beh/sub-02_task-skin2afc_beh.tsv: bad file, left out on request: "),
              std::string::npos);
}

} // namespace
