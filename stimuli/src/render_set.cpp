// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "render_set.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <future>

#include <fmt/format.h>

#include <renderer/gl/context.h>
#include <renderer/reference/reference.h>
#include <stimuli/setup.h>
#include <support/error.h>
#include <support/file.h>
#include <support/progress.h>

#include "contact_sheet.h"
#include "design.h"
#include "manifest.h"
#include "picture_file.h"
#include "recipe.h"

namespace stimuli {
namespace {

namespace fs = std::filesystem;
namespace passes = renderer::passes;
namespace scene = renderer::scene;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

// Frames that wait to be encoded; each holds up to 32 MB at the size of the paper's stimuli.
constexpr std::size_t longest_queue = 3;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The files of one image.
struct Files {
    std::string png_digest, exr_digest; ///< SHA-256; empty if not written
    double seconds = 0;                 ///< spent on writing them
};

/// An image that has been rendered and is being encoded.
struct Encoding {
    std::size_t outcome;
    std::future<Files> files;
};

/// One run of the command.
class SetRenderer {
public:
    explicit SetRenderer(const SetRequest& request)
        : request_(request), protocol_(study::read_protocol(request.protocol_file)),
          selection_(selection(request.only, request.shard, protocol_)) {}

    SetReport run() {
        const auto start = Clock::now();
        timed("loading the model", [&] { model_ = load_model(protocol_, request_.model_file); });
        timed("making a context", [&] { context_.emplace(renderer::gl::Context::headless()); });
        report_.driver = renderer::gl::driver_info().renderer;
        report_.model = model_.name;
        Manifest manifest(request_.out, header());
        check_folder(manifest);
        plan(manifest);
        prepare();
        support::make_writable_folder(request_.out);
        manifest.keep_only(recipe_digests_);
        render(manifest);
        finish(manifest);
        report_.seconds = seconds_since(start);
        return std::move(report_);
    }

private:
    template <typename Work>
    void timed(const char* what, const Work& work) {
        const auto start = Clock::now();
        work();
        add_cost(what, seconds_since(start));
    }
    void add_cost(const char* what, double seconds) {
        report_.costs[what].seconds += seconds;
        ++report_.costs[what].runs;
    }

    Json header() const {
        return {{"program", "skin2afc"},
                {"protocol", {{"name", protocol_.name}, {"digest", protocol_.digest}}},
                {"model", {{"name", model_.name}, {"digest", model_.digest}}},
                {"renderer", report_.driver}};
    }

    /// Rendering a part of the set with another model would drop the rest of the folder's images: more likely
    /// a forgotten --model than a wish.
    void check_folder(const Manifest& manifest) const {
        const bool part = !request_.only.empty() || !request_.shard.empty();
        for (const auto& [name, entry] : manifest.entries()) {
            const Json& parameters = entry["parameters"];
            const bool same = parameters.contains("model") && parameters["model"] == model_.digest;
            if (part && !same && !request_.force) {
                throw support::input_error(
                    "{}: expected images of the model {}, found {} of another model; give --model, "
                    "another folder, or --force",
                    request_.out.string(), model_.name, name);
            }
        }
    }

    /// A protocol that does not list the reference has its images if they are asked for by name, or already
    /// there.
    study::Protocol protocol_with_reference(const Manifest& manifest) const {
        study::Protocol protocol = protocol_;
        const auto entries = manifest.entries();
        const bool there = std::any_of(entries.begin(), entries.end(), [](const auto& entry) {
            return entry.second.value("shader", "") == reference_shader;
        });
        if (!listed(reference_shader) && (asked_for(reference_shader) || there)) {
            protocol.shaders.emplace_back(reference_shader);
        }
        return protocol;
    }
    bool listed(const std::string& shader) const {
        return std::find(protocol_.shaders.begin(), protocol_.shaders.end(), shader) !=
               protocol_.shaders.end();
    }
    bool asked_for(const std::string& shader) const {
        return std::find(selection_.shaders.begin(), selection_.shaders.end(), shader) !=
               selection_.shaders.end();
    }

    /// Decide for each image whether it must be rendered.
    void plan(const Manifest& manifest) {
        const scene::HeadFrame head = head_frame(protocol_, model_);
        items_ = design(protocol_with_reference(manifest));
        const auto entries = manifest.entries();
        for (const Item& item : items_) {
            recipes_.push_back(recipe(item, protocol_, model_, head, report_.driver));
            recipe_digests_[item.name()] = recipes_.back().digest;
            report_.outcomes.push_back(
                {item.name(), reason(item, recipes_.back(), entries), false, 0, {}, {}});
        }
    }

    /// Meet all that the renderer could refuse, before anything is written.
    void prepare() {
        for (std::size_t i = 0; i < items_.size(); ++i) {
            if (!to_render(report_.outcomes[i])) {
                continue;
            }
            if (!recipes_[i].shader) {
                if (!reference_) {
                    reference_.emplace(model_, reference_look(protocol_), reference_settings(protocol_));
                }
            } else {
                if (!pipeline_) {
                    pipeline_.emplace(model_, look(protocol_), methods(protocol_));
                }
                pipeline_->prepare(*recipes_[i].shader, recipes_[i].camera, recipes_[i].light);
            }
        }
    }

    /// Why an image has to be rendered; "up to date" or "not selected" if it has not.
    std::string reason(const Item& item, const Recipe& recipe,
                       const std::map<std::string, Json>& entries) const {
        if (!selection_.keeps(item, protocol_) || !(listed(item.shader) || asked_for(item.shader))) {
            return "not selected";
        }
        if (request_.force) {
            return "forced";
        }
        const auto found = entries.find(item.name());
        if (found == entries.end()) {
            return "new";
        }
        if (found->second["recipe"].get<std::string>() != recipe.digest) {
            return changed_parameters(found->second, recipe);
        }
        const fs::path file = request_.out / (item.name() + ".png");
        if (!fs::exists(file) ||
            support::sha256_of_file(file) != found->second["sha256"].get<std::string>()) {
            return "its file is missing or changed";
        }
        const fs::path linear = request_.out / (item.name() + ".exr");
        if (request_.exr && !(found->second.contains("exr_sha256") && fs::exists(linear) &&
                              found->second["exr_sha256"] == support::sha256_of_file(linear))) {
            return "its linear image is missing or changed";
        }
        return "up to date";
    }

    static std::string changed_parameters(const Json& entry, const Recipe& recipe) {
        std::string names;
        for (const auto& [key, value] : recipe.parameters.items()) {
            const Json& before = entry["parameters"];
            const bool same = before.contains(key) && before[key] == value;
            if (!same) {
                names += (names.empty() ? "" : ", ") + key;
            }
        }
        return "changed: " + names;
    }

    static bool to_render(const Outcome& outcome) {
        return outcome.reason != "up to date" && outcome.reason != "not selected";
    }

    void render(Manifest& manifest) {
        const auto count = static_cast<std::size_t>(
            std::count_if(report_.outcomes.begin(), report_.outcomes.end(), to_render));
        if (count == 0) {
            return;
        }
        progress_.emplace("rendering", count);
        for (std::size_t i = 0; i < items_.size(); ++i) {
            Outcome& outcome = report_.outcomes[i];
            if (!to_render(outcome)) {
                continue;
            }
            const auto start = Clock::now();
            const Recipe& recipe = recipes_[i];
            scene::Frame frame =
                recipe.shader ? pipeline_->render(*recipe.shader, recipe.camera, recipe.light, request_.exr)
                              : reference_->render(recipe.camera, recipe.light, request_.exr);
            references_rendered_ += recipe.shader ? 0 : 1;
            outcome.rendered = true;
            outcome.milliseconds = 1000 * seconds_since(start);
            outcome.passes_run = frame.passes_run;
            outcome.passes_reused = frame.passes_reused;
            encode(i, std::move(frame));
            drain(manifest, longest_queue);
        }
        timed("waiting for files", [&] { drain(manifest, 0); });
        if (pipeline_) {
            for (const auto& [node, cost] : pipeline_->costs()) {
                report_.costs[node] = cost;
            }
            report_.warnings = pipeline_->warnings();
        }
        if (reference_) {
            for (const auto& [stage, seconds] : reference_->seconds()) {
                report_.costs[stage] = {seconds, references_rendered_};
            }
        }
        progress_.reset();
    }

    /// Write the image's files on another thread while the next image is rendered.
    void encode(std::size_t i, scene::Frame frame) {
        const std::string stem = (request_.out / items_[i].name()).string();
        queue_.push_back(
            {i, std::async(std::launch::async, [stem, exr = request_.exr, frame = std::move(frame)] {
                 const auto start = Clock::now();
                 Files files;
                 if (exr) {
                     files.exr_digest = write_exr(stem + ".exr", frame);
                 } else {
                     fs::remove(stem + ".exr"); // of another picture than the one to be written
                 }
                 files.png_digest = write_png(stem + ".png", frame);
                 files.seconds = seconds_since(start);
                 return files;
             })});
    }

    /// Enter finished images into the manifest, waiting until at most `longest` are left in the queue.
    void drain(Manifest& manifest, std::size_t longest) {
        while (queue_.size() > longest) {
            Encoding encoding = std::move(queue_.front());
            queue_.pop_front();
            const Files files = encoding.files.get();
            add_cost("encoding (beside rendering)", files.seconds);
            const Item& item = items_[encoding.outcome];
            const Outcome& outcome = report_.outcomes[encoding.outcome];
            Json entry{{"shader", item.shader},
                       {"distance", item.distance.name},
                       {"azimuth_deg", item.azimuth_deg},
                       {"file", item.name() + ".png"},
                       {"sha256", files.png_digest},
                       {"recipe", recipes_[encoding.outcome].digest},
                       {"milliseconds", outcome.milliseconds},
                       {"passes_run", outcome.passes_run},
                       {"passes_skipped", outcome.passes_reused},
                       {"parameters", recipes_[encoding.outcome].parameters}};
            if (!files.exr_digest.empty()) {
                entry["exr_sha256"] = files.exr_digest;
            }
            manifest.add(item.name(), entry);
            progress_->step(item.name());
        }
    }

    /// Once the folder holds the whole set, draw its contact sheet, unless it shows the same already.
    void finish(Manifest& manifest) {
        const auto entries = manifest.entries();
        for (const Item& item : items_) {
            const bool there =
                entries.contains(item.name()) && fs::exists(request_.out / (item.name() + ".png"));
            report_.missing += there || !listed(item.shader) ? 0 : 1;
        }
        if (report_.missing > 0) {
            return;
        }
        std::string inputs;
        for (const std::string& shader : protocol_.shaders) {
            for (const Item& item : items_) {
                if (item.shader == shader) {
                    inputs += item.name() + entries.at(item.name())["sha256"].get<std::string>();
                }
            }
        }
        inputs = support::sha256(inputs);
        if (manifest.contact_sheet_inputs() != inputs || !fs::exists(request_.out / "contact_sheet.png")) {
            timed("contact sheet", [&] { write_contact_sheet(request_.out, protocol_); });
            manifest.note_contact_sheet(inputs);
        }
    }

    const SetRequest& request_;
    study::Protocol protocol_;
    Selection selection_;
    scene::Model model_;
    std::optional<renderer::gl::Context> context_;
    std::vector<Item> items_;
    std::vector<Recipe> recipes_; // as items_
    std::map<std::string, std::string> recipe_digests_;
    std::optional<passes::Pipeline> pipeline_;
    std::optional<renderer::reference::Reference> reference_;
    int references_rendered_ = 0;
    std::deque<Encoding> queue_;
    std::optional<support::Progress> progress_;
    SetReport report_;
};

} // namespace

SetReport render_set(const SetRequest& request) { return SetRenderer(request).run(); }

} // namespace stimuli
