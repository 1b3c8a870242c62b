// Numbers of the localizer, each with its evidence.  "Chosen": by judgement, and never swept; the rows of
// tests/pipeline/accuracy.csv stand for all of them together.  "Blocks": the hololens recording, frames in turn map
// and query, 20 at a time, where maps show a place from elsewhere.
#pragma once
#include <cstdint>

#include "runtime/base/elementary.h"

namespace sphc::tuning {

constexpr double degrees(double value) { return value * kPi / 180; }

// ---- what a frame needs at least ----

// Chosen: below these there is too little for three matches and a test of chance.
constexpr uint32_t kFewestKeypoints = 32, kFewestLifted = 16, kFewestMatches = 6;

// ---- lifting ----

// Coarser keypoints are placed less exactly: their error grows in proportion to their scale beyond this.  Chosen.
constexpr double kFineScalePx = 2;
// Where a keypoint without depth is taken to lie, as far as the map's error goes.  Chosen: the order of a room's
// depths.
constexpr double kRayM = 1;

// ---- a deadline: shares of the time that is left, each at the beginning of its part ----

// The end is kept for what follows the search: telling what became of keypoints, and learning.
constexpr double kUntilEnd = 0.98;
// With a pose expected, matching takes less time, and more can go to features.
constexpr double kFeaturesShare = 0.38, kFeaturesNearShare = 0.43, kLiftShare = 0.4;
// Of a search near an expected pose, after which the whole map is searched: it fails seldom, and where it does a
// short deadline leaves too little for the other.  Of what is left the matching.
constexpr double kNearShare = 0.95, kMatchShare = 0.5;
// Within verification: of a robust search; of guided re-matching, also of an expected pose, which needs no
// confirmation but must know its leverage, and of that of its first cone; of a second search and its re-matching.
// What is left is for confirmation.
constexpr double kSearchShare = 0.6, kRematchShare = 0.8, kRematchNearShare = 0.76, kFirstConeShare = 0.65,
                 kAgainShare = 0.5;

// ---- search: where in the maps to look ----

// The search cone of an expected pose: so many sigmas, but no less than a cone in which agreement still proves
// something (a narrower one is filled by the inlier regions: decision 13), and beyond the most the whole map is
// searched.  Chosen.
constexpr double kConeSigmas = 3, kLeastConeRad = degrees(2.5), kMostConeRad = degrees(10);
// Where a deadline cut the features a vaguer pose is a place to begin as well: such frames have few inliers, so the
// next one's expected pose is vague.  Swept: at 10, 15 and 20 degrees 79, 91 and 94 % of redkitchen's poses
// were left in tracking at 2.5 ms.
constexpr double kMostConeInHasteRad = degrees(20);
constexpr double kTypicalDepthM = 2;  // chosen; turns an error of the camera's place into an angle
// Keypoints with depth that are asked first: they often tell the pose already.  Chosen.
constexpr uint32_t kStrongest = 200;
// Guided re-matching leans towards the pose it was made with: where not all matches were asked, the first ones must
// leave no doubt.  Log of the chance; wrong poses on foreign maps were never seen below -6, the rest is margin.
constexpr double kBeyondDoubt = -30;
// Where a deadline leaves no time to ask the others, the pose needs so many times the inliers: with 12 one was 49
// cm off.
constexpr uint32_t kTimesInliersUnasked = 2;
// Which map?  Of so many keypoints, how many find their like in each, in so many cells of the index; the best maps
// are then searched, but none with less than half of the first's.  Chosen.
constexpr uint32_t kVoters = 200, kVoteProbes = 4, kMapsTried = 3;

// ---- verification ----

// Half angles of the cones of guided re-matching, one after another: the first is generous towards a pose of three
// noisy matches, the second leaves out most fakes.  Chosen.
constexpr double kConesOfSearchedPose[] = {degrees(4), degrees(2.5)}, kConesOfExpectedPose[] = {degrees(2.5)};
// What two poses that are the same may differ by.
struct PoseBounds {
  double most_shift_m, most_turn_rad;
};

// A pose whose camera centre would be so many times vaguer without its high-leverage observations rests on them: on
// blocks one that rested on such stood 37 cm off at a stated 2 cm (decision 13).
constexpr double kRestsOnFew = 1.8;
// One in so many inliers may be left out; among more than these a few that are wrong have no say.  Chosen.
constexpr uint32_t kInliersALeverage = 12, kInliersBeyondChallenge = 60;
// A pose of few inliers is no pose if there is another one without the quarter, or the third, of them that it
// depends on most, which gains nearly as much.  With 12 keys on thin and reversed redkitchen and on blocks (18 491
// poses) each of 9 wrong poses has one, which gains 0.95 times as much or more, and of 17 031 right ones 50.
constexpr uint32_t kFewInliers = 24, kLeftOutOfFew[] = {4, 3};
constexpr double kNearlyAsGoodOfFew = 0.9;
constexpr PoseBounds kSamePoseOfFew = {0.10, degrees(5)};
// Of a planar scene's two poses the right one gained 1.6 times what the other did, or more, on real recordings.
constexpr double kNearlyAsGood = 0.8, kSamePoseRad = degrees(5);

// A pose is challenged by the keypoints that do not speak for it.  In simulated rooms with equal furniture, or with
// the holder's feet in map and query, 8 wrong poses of up to 80 inliers all had a rival of 0.55 to 2.2 times their
// gain; of 1311 right poses on real recordings one had (decision 42).
// One of more inliers is seldom wrong: fewer keypoints are asked, and the rival must gain more of what it gains.
// Wrong poses in flats of equally furnished rooms had up to 223 inliers (decision 100).
constexpr uint32_t kInliersSeldomWrong = 100, kInliersBeyondOthers = 300;
struct ChallengeByOthers {
  uint32_t most_keypoints, most_samples;
  double ambiguous_gain;
};
constexpr ChallengeByOthers kOfFewInliers = {UINT32_MAX, 2000, 0.5}, kOfManyInliers = {400, 1000, 0.7};
constexpr PoseBounds kSamePose = {0.15, degrees(8)};
constexpr double kMostLogChanceOfRival = -6;  // of its first matches; of the eight it was -12 and less

// ---- repetition: a pose that is off by the period of what is seen (decisions 49 and 83) ----

// Of so many keypoints, the strongest, each is asked for its like: another one, at least so far away, with a
// squared distance of descriptors below this.  Chosen.
constexpr uint32_t kAskedForLike = 400, kMostDistance2OfLike = 60000;
constexpr double kLeastMoveM = 0.10, kSameMoveM = 0.03;
// So many equal moves are a pattern.  Chosen: carpets show 20 to 60, a kitchen up to 30.  The commonest of so many
// directions are asked: those of the two sides of a tile, and one between them (decision 105).
constexpr uint32_t kFewestMoves = 10, kMostMoves = 3;
// What is found without all that repeats replaces a pose of a smaller gain where it is another one.  Chosen.
constexpr PoseBounds kSamePoseUnrepeated = {0.05, degrees(2.5)};
// A pose rests on a pattern where fewer of its inliers than this, and less than this share, are of what does not
// repeat; it is ambiguous where one that is off by a period or two gains this share of what it gains.  Eight rooms
// with carpet, feet and hands in view (telephone of nasty.py, 2560 frames): wrong poses 24 -> 6, right ones 1793 ->
// 1717.  Redkitchen, thin and reversed (4560 frames): right ones 68.18 -> 68.14 %.  Without the share 66.7 %.
constexpr uint32_t kFewestUnrepeated = 12;
constexpr double kLeastUnrepeated = 0.25, kRepeatedGain = 0.5;
// Any other pose is ambiguous where one of this share of its gain has as many inliers that do not repeat; these are
// not asked where the mean gain of the pose's inliers is below this (by chance 0.5, in right poses 0.75 to 0.95).
// Rooms with carpet or tiles and feet (3584 poses): wrong 67 -> 5, right 3506 -> 3371; on recordings 1390 -> 1384.
constexpr double kPeriodGain = 0.8, kLeastMeanGain = 0.8;
// A track follows what it began with, so there the other needs this share of such inliers: wrong 67 -> 1, right
// 3506 -> 3163; on recordings 1390 -> 1382.
constexpr double kUnrepeatedToTrack = 0.5;
// Not ambiguous, but less sure: a rival that gains more than this share by the other keypoints, or that is off by a
// period, gains more than this share and has this share of such inliers (decision 100).
constexpr double kGainOfNearRival = 0.5, kPeriodGainOfNearRival = 0.65, kUnrepeatedOfNearRival = 0.8;
// Of more inliers no pose was off by a period; of 150 to 165 some were (rooms with tiles and feet, maps of ten
// frames, 2880 single frames): wrong 32 -> 13, right 2415 -> 2415.
constexpr uint32_t kInliersBeyondPattern = 300;
// A pose is known where it was expected and this share of its matches agree: it is searched for without what
// repeats where it has as few inliers as poses that must be confirmed, and not compared with others.  Rooms with
// tiles and feet, or carpet, at 30 Hz, maps of three frames (2400 frames): wrong 60 -> 19, right 1220 -> 1245.
constexpr double kAgreeingOfKnown = 0.5;

// ---- mirror images (decision 56) ----

// Of the inliers of a pose so many are asked where they lie; a spot is a cone about one of them, twice as wide as a
// patch of fakes is by default (8 degrees).
constexpr uint32_t kAskedForSpread = 256;
constexpr float kSpotCosine = 0.990268f;  // of 8 degrees
// Of the inliers of a mirror image's pose so many lie elsewhere at most.  Over 12 keys of seven recordings (8280
// mirrored frames, eta 33 %) it were up to 68 % where they were fewer than 30, and never more than 25; with 60
// inliers and more 11 %.  2 % of sound poses on redkitchen and 22 % on hololens have as few.
constexpr uint32_t kFewElsewhere = 30;
constexpr double kMostElsewhereOfFew = 0.7, kMostElsewhereOfMirrored = 0.35;
// A frame without a pose is asked where it has clear matches with the map, for so many of its keypoints.
constexpr double kLeastClearOfMirrored = 0.01;
// A frame is a mirror image where its mirror image has so many inliers elsewhere, and so many times its own.
// Sound frames had up to 7 there, and then 4 of their own.
constexpr uint32_t kFewestElsewhere = 10, kTimesElsewhere = 2;

// ---- confirmation: a second, independent search must find a doubtful pose again ----

// Poses of a search in the whole map are doubtful below so many inliers: all wrong poses that were accepted on real
// recordings had fewer.  In simulated halls with equal furniture some had up to 67.
constexpr uint32_t kInliersBeyondConfirmation = 50;
// On 11 124 frames (six keys; redkitchen, a thin map of it, both ways round, hololens and its blocks; eta 33 and
// 25 %) the two took the poses beyond 25 cm or 10 deg from 14 to 1, beyond 10 cm or 5 deg from 94 to 33, and the
// right ones from 67.1 to 66.9 %.  The first alone costs 1.3 points of these, two that agree cost ten.
struct ConfirmingSearch {
  float max_ratio;
  PoseBounds agreement;
};
constexpr ConfirmingSearch kConfirmingSearches[] = {{0.90f, {0.05, degrees(2.5)}}, {0.95f, {0.10, degrees(5)}}};
// A frame without a pose is searched once more at the first of these ratios, and the second must confirm what that
// finds.  On 18 020 frames (thin and reversed redkitchen, blocks of both hololens walks; eta 33 and 25 %) it
// brought 92 poses of 20 inliers and more, twice what the default config asks for: 78 were within 5 cm and 5 deg,
// one beyond 10 cm.  Of 37 with fewer, on a third of these frames, 4 were (decision 43).
constexpr float kLooserRatio = kConfirmingSearches[0].max_ratio;
constexpr uint32_t kTimesInliersOfLooser = 2;
constexpr uint64_t kOtherSeed = 0x9E3779B97F4A7C15u;  // any

// ---- judgement ----

constexpr double kMostLogChance = -12;               // wrong poses on foreign maps were never seen below -6
constexpr double kMostLogChanceExpected = -6;        // an expected pose is likely beforehand (decision 13)
constexpr double kMostRotationSigmaRad = 0.05;       // doubted as below (decision 13)
constexpr double kMostTranslationSigmaM = 0.10;      // the same
constexpr double kMostSigmaWithoutLeverageM = 0.15;  // all poses that it refuses on blocks were more than 5 cm off
// Errors of the map and outliers among few inliers are not in the covariance: on blocks poses from 15 to 25 inliers
// were off by 5 sigma, from 100 and more by less than 2.
constexpr double kInliersOfDoubt = 60;

// ---- doubt; docs/consistency.md has the evidence ----

constexpr double kBiasSigmas = 2.5;  // of the prior
constexpr double kVerticalSigmas = 3, kLeastVerticalRad = degrees(1);
// Where the score of a focal length is beyond the first, its optimum is looked for; beyond the others it is a
// fault.
constexpr double kDoubtfulFocalSigmas = 1.5, kFocalSigmas = 3.5, kLeastFocalOff = 0.045;
constexpr double kMostConfidenceOfFaults = 0.25, kMostConfidenceOfDoubt = 0.5, kMostConfidenceOfNearRival = 0.95;
// Of a map point's distance by one frame, beside depth's and the pose's errors: what maps and biases are off by.
constexpr double kDistanceFloorM = 0.007, kDistanceShare = 0.007;
// A pose of so many inliers is not doubted for its edges alone: of poses that late, mirrored or displaced depth
// made wrong and sure the median has 49, and one in six has so many.
constexpr uint32_t kInliersBeyondDoubtfulEdges = 100;

// ---- hints; docs/hints.md has the evidence ----

constexpr int32_t kLightColumns = 64, kLightRows = 48;  // grid of samples of level and noise
constexpr int32_t kFewestLevels = 3;                    // nearer to black or white a pixel may be clipped
constexpr uint32_t kFewestUnclipped = 8;                // one in so many tells the noise
constexpr double kLeastNoise = 1;                       // grey levels: what an image of 8 bits resolves
// Quarter of the samples, and that quantile of |difference of Laplacians|, 6 sigma wide, for noise of 1.
constexpr double kQuietShare = 0.25, kQuietQuantile = 6 * 0.3186;
constexpr double kLeastLightOverNoise = 12;
// A share of the image that is white has lost edges.  Sound frames have 0.08 at most, twice as much light 0.16 at
// least.
constexpr double kMostClipped = 0.125, kWhite = 253;

constexpr int32_t kSharpColumns = 96, kSharpRows = 72;
constexpr int32_t kFineSteps = 2, kCoarseSteps = 16;
constexpr double kFocalOfAStep = 500;  // px
constexpr double kLeastContrast = 4;   // grey levels, over many pixels; and as much as noise
constexpr double kMostAlong = 0.05, kLeastAcross = 0.02, kAcrossOverAlong = 1.6;

constexpr double kSalient = 5;  // sigmas of noise
constexpr uint32_t kFewestSalient = 60;
constexpr uint32_t kOneWithDepthIn = 8;  // keypoints

constexpr double kClearRatio = 0.65, kStrangersClear = 0.002;
constexpr uint32_t kFewestClear = 3;

// ---- fusion: matches of several frames ----

constexpr uint16_t kMostFramesTogether = 60;  // chosen: 2 s at 30 Hz
constexpr double kVagueM = 0.06;              // chosen: sideways sigma beyond which a match is worth nothing

// ---- tracking ----

// How a head moves, 1 sigma: with the velocity known, and without.  Chosen, and so is
// all that follows.
constexpr double kTurnAcceleration = 6, kAcceleration = 4;           // rad / s^2, m / s^2
constexpr double kTurnRate = 1, kSpeed = 0.7;                        // rad / s, m / s
constexpr double kLeastTurnSigma = 0.003, kLeastShiftSigma = 0.005;  // rad, m: a pose is never better known
constexpr double kSteadySeconds = 0.25;                              // poses further apart tell no velocity
constexpr uint64_t kNearNs = 100000000;                              // beside a frame, motion is steady for so long
constexpr uint64_t kReachNs = 500000000;  // so long before a frame an image of it may be taken; odometry drifts
constexpr double kGateSigmas = 5;         // within which two poses agree
// Images of different times that nothing brings together: the camera has moved so far meanwhile, 1 sigma an axis,
// as people walk; so is depth off, whose keypoints have the rays of the colour image.  Those of a further camera
// have rays of its own, which turn with the head: kTurnRate.  Beyond kMostTogetherS a frame teaches nothing; clocks
// that differ make no more of it than kMostApartS.
constexpr double kSpeedApart = 0.35, kTurnApart = 0.08;     // m / s, rad / s
constexpr double kMostTogetherS = 0.05, kMostApartS = 1.0;  // s
// A jump is beyond this by the gate.  It needs so many times the inliers of the track.  Chosen.
constexpr PoseBounds kNoJump = {0.15, degrees(8)};
constexpr double kTimesSupport = 2;
// What a search near a track finds beyond this by the gate must be found in the whole map: floors repeat.  Chosen.
constexpr PoseBounds kNoJumpOfTrack = {0.05, degrees(3)};
// A track is trusted from a pose of more confidence than this on (decision 88): not from one with a near rival.
constexpr double kSureOfTrack = 0.95;
// A pose that neither a sure track nor the caller expects is not sure where, of the frames before it, so many and
// this share were ambiguous.  A frame counts half as much after a third of a second: below five frames a second
// never so many.  Decision 104.
constexpr double kFewestAmbiguous = 2, kShareAmbiguous = 1.0 / 3;
// Where the camera is expected so vaguely, 1 sigma, any pose is one that agrees, and no track goes on with it.
// Chosen: as after a third of a second without odometry.
constexpr double kVagueTurnRad = 0.35, kVagueShiftM = 0.25;
// Odometry is left out that so often moved by as much as a jump otherwise than poses did, on the way or in so many
// steps in a row.  Of its shifts it is not asked what a scale of depth explains, up to this factor.  Chosen.
constexpr uint32_t kContradictionsOfOdometry = 2, kStepsApart = 3;
constexpr double kMostScaleOfDepth = 4;

}  // namespace sphc::tuning
