// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <set>

#include <gtest/gtest.h>

#include <support/file.h>

#include "accuracy/report.h"

namespace {

using measure::AccuracyResult;
using measure::AccuracyRow;
using measure::Setting;
using renderer::passes::Shader;

AccuracyRow row(const std::string& shader, const std::string& setting, const std::string& distance,
                int azimuth_deg, double time_ms, double flip) {
    AccuracyRow result;
    result.shader = shader;
    result.setting = setting;
    result.distance = distance;
    result.azimuth_deg = azimuth_deg;
    result.time_ms = time_ms;
    result.errors.flip = flip;
    return result;
}

AccuracyResult result() {
    AccuracyResult all;
    all.model = "<head> & shoulders";
    all.width = 1650;
    all.height = 988;
    all.rows = {row("no_sss", "default", "near", 0, 10, 0.1),
                row("no_sss", "default", "near", 60, 12, 0.3),
                row("ts", "default", "near", 0, 40, 0.04),
                row("ts", "default", "near", 60, 40, 0.06),
                row("ss_full", "default", "near", 0, 30, 0.05),
                row("ss_full", "default", "near", 60, 30, 0.06),
                row("ss_full", "25 taps", "near", 0, 15, 0.05),
                row("ss_full", "25 taps", "near", 60, 15, 0.05),
                row("ss_jittered", "default", "near", 0, 20, 0.06),
                row("ss_jittered", "default", "near", 60, 20, 0.06)};
    all.closed_forms = {{"plane", "ts", "default", "near", 0.005}, {"dot", "ts", "default", "near", 0.01}};
    return all;
}

} // namespace

TEST(AccuracyTest, mediansAndDeviationsLeaveOneOutlierOut) {
    EXPECT_EQ(measure::median({5, 1, 1000}), 5);
    EXPECT_EQ(measure::median({4, 1, 2, 1000}), 3);
    EXPECT_EQ(measure::median_deviation({5, 1, 6, 4, 1000}), 1); // distances 0, 4, 1, 1, 995 from 5
}

TEST(AccuracyTest, withoutAProtocolTheShippedOneIsMeant) {
    EXPECT_EQ(measure::study_of_2009().digest,
              support::sha256_of_file(SKIN2AFC_PROTOCOLS "/jimenez2009.toml"));
}

TEST(AccuracyTest, sweepsEveryAxisThatAUserCanTurn) {
    std::set<int> map_sizes, taps, bits, jittered;
    std::set<bool> half, gaps, published_taps;
    std::set<std::string> ts_profiles, full_profiles, names;
    for (const Setting& s : measure::settings(measure::study_of_2009(), false)) {
        EXPECT_TRUE(names.insert(std::string(shader_name(s.shader)) + s.name).second) << s.name;
        if (s.shader == Shader::ts) {
            map_sizes.insert(s.methods.ts.map_size);
            ts_profiles.insert(s.profile);
        } else if (s.shader == Shader::ss_full) {
            taps.insert(s.methods.full.taps);
            bits.insert(s.methods.full.target_bits);
            half.insert(s.methods.full.half_resolution);
            gaps.insert(s.methods.full.reject_gaps);
            published_taps.insert(s.methods.full.published_taps);
            full_profiles.insert(s.profile);
        } else if (s.shader == Shader::ss_jittered) {
            jittered.insert(s.methods.jittered.taps);
        }
    }
    EXPECT_EQ(map_sizes, (std::set{256, 512, 1024, 2048, 4096}));
    EXPECT_EQ(taps, (std::set{7, 9, 13, 25}));
    for (const int wanted : {8, 16, 32}) {
        EXPECT_TRUE(bits.contains(wanted));
    }
    EXPECT_EQ(jittered, (std::set{13, 25, 49}));
    EXPECT_EQ(half.size() + gaps.size() + published_taps.size(), 6U);
    EXPECT_EQ(ts_profiles, (std::set<std::string>{"skin_4g_jimenez2010", "skin_6g_deon2007"}));
    EXPECT_EQ(full_profiles, ts_profiles);
}

TEST(AccuracyTest, quickSettingsAreSomeOfAll) {
    std::set<std::string> all;
    for (const Setting& s : measure::settings(measure::study_of_2009(), false)) {
        all.insert(std::string(shader_name(s.shader)) + s.name);
    }
    const auto quick = measure::settings(measure::study_of_2009(), true);
    EXPECT_EQ(quick.front().shader, Shader::no_sss); // what the others are checked against
    EXPECT_LT(quick.size(), all.size() / 2 + 1);
    for (const Setting& s : quick) {
        EXPECT_TRUE(all.contains(std::string(shader_name(s.shader)) + s.name)) << s.name;
    }
}

// Means: no_sss 11 ms, 0.2; ts 40, 0.05; ss_full 30, 0.055 and 15, 0.05; ss_jittered 20, 0.06. Only no_sss
// and the 25 taps are not beaten: ts has their FLIP, but not their time.
TEST(AccuracyTest, theFrontHoldsWhatNothingBeats) {
    const auto all = measure::summaries(result().rows);
    ASSERT_EQ(all.size(), 5U);
    EXPECT_NEAR(all[0].flip, 0.2, 1e-12);
    EXPECT_NEAR(all[0].time_ms, 11, 1e-12);
    const auto front = measure::front_of(all, "near");
    ASSERT_EQ(front.size(), 2U);
    EXPECT_EQ(front[0].shader, "no_sss");
    EXPECT_EQ(front[1].setting, "25 taps");
}

TEST(AccuracyTest, findingsCompareWithTsAndNoScattering) {
    const auto sentences = measure::accuracy_findings(result(), measure::summaries(result().rows));
    ASSERT_EQ(sentences.size(), 2U);
    EXPECT_NE(sentences[0].find("half that of no_sss in 2 of 2 views"), std::string::npos) << sentences[0];
    EXPECT_NE(sentences[0].find("that of ts in 1."), std::string::npos) << sentences[0];
    EXPECT_NE(sentences[1].find("ss_full (25 taps)"), std::string::npos) << sentences[1];
    EXPECT_NE(sentences[1].find("0.38 of its time"), std::string::npos) << sentences[1];
}

TEST(AccuracyTest, tableHasTheColumnsOfTheFormat) {
    const std::string text = measure::accuracy_tsv(result().rows);
    EXPECT_EQ(text.substr(0, text.find('\n')),
              "shader\tsetting\tdistance\tazimuth_deg\ttime_ms\ttime_spread_ms\trmse\tpsnr_db\tde2000_"
              "mean\tde2000_p95\t"
              "ssim\tflip\trmse_all\tobject_pixels\tscatter_ms\tscatter_spread_ms");
    EXPECT_NE(text.find("\nno_sss\tdefault\tnear\t60\t12\t0\t"), std::string::npos);
}

TEST(AccuracyTest, pageIsSelfContainedAndEscapesNames) {
    const auto all = measure::summaries(result().rows);
    const std::string svg = measure::accuracy_svg(result(), all);
    const std::string html = measure::accuracy_html(result(), all, svg);
    EXPECT_NE(html.find("&lt;head&gt; &amp; shoulders"), std::string::npos);
    EXPECT_EQ(html.find("<head> &"), std::string::npos);
    for (const char* elsewhere : {"src=\"http", "href=\"http", "<script", "@import"}) {
        EXPECT_EQ(html.find(elsewhere), std::string::npos) << elsewhere;
    }
    for (const char* shader : {"no_sss", "ts", "ss_jittered", "ss_full"}) {
        EXPECT_NE(svg.find(shader), std::string::npos) << shader;
    }
    EXPECT_NE(html.find("0.500 %</td><td>1.000 %"), std::string::npos); // the closed forms
}
