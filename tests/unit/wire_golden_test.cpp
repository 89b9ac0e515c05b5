#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <string_view>

#include "tests/unit/wire_support.hpp"

namespace morepro::wire_test {
namespace {

// The bytes were made by a separate program from the tables in lib/wire/README.md (struct.pack and zlib.crc32
// of Python). Recordings hold these bytes: when a test of this file turns red, the format has changed, and
// kProtocolVersion or kConfigurationLayout has to change with it.

std::string hex(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15U];
  }
  return text;
}

SensorFrame golden_frame() {
  SensorFrame frame;
  frame.sequence = 0x01020304;
  frame.time_us = 0xA0B0C0D0;
  frame.set(Channel::kArmatureVoltage, 48.0F);
  frame.set(Channel::kContact, 1.0F);
  frame.set(Channel::kSpindleSpeed, -314.15927F);
  frame.set(Channel::kFeedAcceleration, std::bit_cast<float>(0x7fa00001U));
  return frame;
}

Health golden_health() {
  Health health{.sequence = 7,
                .time_us = 700,
                .state = HealthState::kReplace,
                .reason = 404,
                .frame_flags = 0x0041,
                .rejected_channels = 0x0110,
                .frames_accepted = 6,
                .frames_rejected = 1,
                .frames_missing = 2,
                .chip_load_state = ChipLoadState::kValid,
                .chip_load_mm = 0.0625F,
                .chip_load_standard_error_mm = 0.001953125F,
                .hypothesis_count = 11,
                .selected_hypothesis = 4,
                .selected_probability = 0.875F,
                .spindle_speed_rad_s = 300.5F,
                .feed_speed_m_s = 0.05F,
                .armature_current_a = -std::numeric_limits<float>::quiet_NaN(),
                .innovation_ratio = 1.25F};
  for (std::size_t k = 0; k < kParameterCount; ++k)
    health.parameters[k] = {0.5F * static_cast<float>(k), 0.25F * static_cast<float>(k),
                            static_cast<ParameterStatus>(k % 6),
                            k == 6 ? Partner::kNone : static_cast<Partner>(k + 2)};
  health.gap = {.verdict = gap::GapVerdict::kEffect,
                .where = gap::EffectGroup::kSensor,
                .effect = gap::Effect::kSpindleSpeedBias,
                .alias_count = 2,
                .alias = {gap::Effect::kSupplyVoltageOffset, gap::Effect::kSpindleSpeedBandwidth},
                .confidence = 0.75F,
                .evidence = std::numeric_limits<float>::quiet_NaN()};
  return health;
}

MachineParameters golden_machine() {
  return {.spindle = {.torque_constant_nm_a = 0.1 * 1,
                      .back_emf_constant_vs_rad = 0.1 * 2,
                      .resistance_ohm = 0.1 * 3,
                      .inductance_h = 0.1 * 4,
                      .inertia_kgm2 = 0.1 * 5,
                      .viscous_friction_nms_rad = 0.1 * 6,
                      .winding_time_constant_s = 17.5,
                      .winding_rise_k_a2 = 18.5},
          .feed = {.mass_kg = 0.1 * 7,
                   .contact_force_n = 0.1 * 8,
                   .contact_offset_n = 0.1 * 9,
                   .engagement = 0.1 * 10,
                   .viscous_friction_ns_m = 0.1 * 11,
                   .screw_pitch_m = 0.1 * 12},
          .tool = {.diameter_mm = 0.1 * 13, .teeth = 0.1 * 14, .chip_load_mm = 0.1 * 15},
          .contact = {.form = ContactForm::kThesis,
                      .viscous_gain_nms = 20.5,
                      .edge_force_n = 21.5,
                      .chip_force_n_mm = 22.5,
                      .radius_m = 23.5,
                      .speed_scale_rad_s = 24.5},
          .thermal = {.reference_degc = 25.5, .melting_degc = 26.5, .exponent = 27.5, .tool_degc = 28.5}};
}

MachineEffects golden_effects() {
  MachineEffects effects;
  effects.count = 2;
  effects.effect[0] = {
      .form = {.effect = gap::Effect::kSpindleCogging, .kind = 0, .parts = 2, .shape = 12.0F},
      .coefficient = {0.25, -0.5},
      .onset_s = 1.5};
  effects.effect[1] = {
      .form = {.effect = gap::Effect::kArmatureReaction, .kind = 1, .parts = 1, .shape = 0.0F},
      .coefficient = {0.125},
      .onset_s = 0.0};
  return effects;
}

gap::MachineForms golden_spindle_forms() {
  gap::MachineForms forms{.count = 2};
  forms.form[0] = {.effect = gap::Effect::kSpindleCogging, .kind = 0, .parts = 2, .shape = 7.0F};
  forms.form[1] = {.effect = gap::Effect::kArmatureReaction, .kind = 1, .parts = 1, .shape = 0.0F};
  return forms;
}

gap::MachineForms golden_feed_forms() {
  gap::MachineForms forms{.count = 1};
  forms.form[0] = {.effect = gap::Effect::kFeedStribeckFriction, .kind = 0, .parts = 1, .shape = 0.0625F};
  return forms;
}

MonitorConfiguration golden_configuration() {
  MonitorConfiguration configuration{
      .machine = golden_machine(),
      .sampling = {.rate_hz = 8000.0},
      .grid = {.first_mm = 0.02, .step_mm = 0.015, .count = 0x11121314},
      .tuning = {.speed_process_noise_rad_s = 0.001 * 1,
                 .current_process_noise_a = 0.001 * 2,
                 .feed_process_noise_m_s = 0.001 * 3,
                 .chip_load_drift_mm = 0.001 * 4,
                 .switch_probability = 0.001 * 5,
                 .parameter_start_fraction = 0.001 * 6},
      .wear = {.watch_ratio = 5.25, .replace_ratio = 6.25, .low_ratio = 7.25, .hold_s = 8.25},
      .gap = {.speed_process_noise_rad_s = 0.125,
              .current_process_noise_a = 0.25,
              .feed_process_noise_m_s = 0.375,
              .lost_share = 0.4375,
              .clock_jitter_s = 0.46875,
              .spindle = {.evidence = 30.5,
                          .temperature = 2.5,
                          .excitation = 6.5,
                          .noise_ratio = 1.5,
                          .parameter_spread = 0.0625,
                          .forms = golden_spindle_forms()},
              .feed = {.evidence = 40.5,
                       .temperature = 3.5,
                       .excitation = 7.5,
                       .noise_ratio = 2.5,
                       .parameter_spread = 0.03125,
                       .forms = golden_feed_forms()}},
      .effects = golden_effects(),
      .rule = DecisionRule::kThesis};
  for (std::size_t k = 0; k < kChannelCount; ++k) {
    const auto number = static_cast<double>(k);
    configuration.sensors.by_channel[k] = {.noise = 100.0 + number, .lsb = 1.0e-3 * (number + 1.0)};
  }
  return configuration;
}

wire::Text golden_text() {
  wire::Text text;
  EXPECT_TRUE(text.assign("machine: reference"));
  return text;
}

TEST(WireGolden, FrameHasItsBytes) {
  EXPECT_EQ(hex(encoded(golden_frame())),
            "0c0104030201d0c0b0a01520010340420108803f63149dc30107a07fdd47399500");
}

TEST(WireGolden, HealthHasItsBytes) {
  EXPECT_EQ(hex(encoded(golden_health())),
            "030207010103bc02010503940141041001060101020101010202010102010103803d0101043b0b040103603f08"
            "409643cdcc4c3d0103c07f0103a03f010101010101010102020101023f0105803e01030103803f0101043f0204"
            "0103c03f0105403f0305010102400105803f0406010320400105a03f0507010340400103c03f08ff050321021d"
            "260103403f0107c07f1fd8a88600");
}

TEST(WireGolden, ConfigurationHasItsBytes) {
  EXPECT_EQ(hex(encoded(golden_configuration())),
            "2303079a9999999999b93f9a9999999999c93f343333333333d33f9a9999999999d93f01010101010be03f3433"
            "33333333e33f0101010104803140010101011c803240676666666666e63f9a9999999999e93fcdccccccccccec"
            "3f010101010123f03f9a9999999999f13f343333333333f33fcdccccccccccf43f676666666666f63f01010101"
            "0104f83f0101010101048034400101010104803540010101010480364001010101048037400101010104803840"
            "01010101048039400101010104803a400101010104803b400101010104803c4001010101010b5940fca9f1d24d"
            "62503f010101010c405940fca9f1d24d62603f010101010c805940fa7e6abc7493683f010101010cc05940fca9"
            "f1d24d62703f01010101010b5a407b14ae47e17a743f010101010c405a40fa7e6abc7493783f010101010c805a"
            "4079e9263108ac7c3f010101010cc05a40fca9f1d24d62803f01010101010b5b403cdf4f8d976e823f01010101"
            "0c405b407b14ae47e17a843f010101010c805b40ba490c022b87863f010101010cc05b40fa7e6abc7493883f01"
            "010101010b5c403ab4c876be9f8a3f010101010c405c4079e9263108ac8c3f010101014840bf407b14ae47e17a"
            "943fb81e85eb51b88e3f14131211fca9f1d24d62503ffca9f1d24d62603ffa7e6abc7493683ffca9f1d24d6270"
            "3f7b14ae47e17a743ffa7e6abc7493783f010101010103154001010101010319400101010101031d4001010101"
            "0c8020409a9999999999a93f010101010103c03f010101010103d03f010101010103d83f010101010103dc3f01"
            "0101010103de3f0101010104803e4001010101010304400101010101031a40010101010103f83f010101010104"
            "b03f0302020106e0401f0101010101010102010101010101020101010102020101010101010104404440010101"
            "0101030c400101010101031e400101010101030440010101010104a03f0e02010103803d010201010101010102"
            "0101010101010201010101020101010203020201034041010101010103d03f010101010103e0bf010101010101"
            "01010101010101010101010101010106f83f1f010101010101010101010103c03f010101010101010101010101"
            "010101010101010101010101010101010101010101020101010101010101010101010101010101010101010101"
            "010101010101010101010101010101010101010101010102010101010101010101010101010101010101010101"
            "0101010101010101010101010101010101010101010101020201010602fdc3324e00");
}

TEST(WireGolden, ControlRecordsHaveTheirBytes) {
  EXPECT_EQ(hex(encoded(wire::Ready{.protocol_version = 3, .build_id = 0xCAFE0001, .reset_cause = 1})),
            "0404030108feca01fbf19f2b00");
  EXPECT_EQ(hex(encoded(wire::End{.frames = 20000})), "0405204e01059977f4d400");
  EXPECT_EQ(hex(encoded(golden_text())), "18066d616368696e653a207265666572656e6365f119949100");
}

}  // namespace
}  // namespace morepro::wire_test
