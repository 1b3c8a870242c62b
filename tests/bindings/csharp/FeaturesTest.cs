using System;
using SphereCloud;

/// <summary>Features that are read out, and put in.</summary>
internal static class FeaturesTest {
  public static void FeaturesThatWereReadOutLocateAgain() {
    LocalizerConfig config = Session.Config();
    LocalizerFrame frame = Session.Frame(0);
    LocalizerResult wanted, found;
    using (Localizer first = Session.Localizer(), second = Session.Localizer())
    using (Features extracted = new Features(config), set = new Features(config)) {
      first.Extract(frame, extracted);
      Expect.True(first.Locate(frame, extracted, out wanted), "localizes");
      FeatureArrays arrays = extracted.Read();
      Expect.Equal((int)wanted.Keypoints, arrays.Keypoints.Length, "keypoints");
      Expect.Equal(Library.ExtractorId, arrays.Extractor, "extractor");
      set.Set(frame, arrays);
      second.Locate(frame, set, out found);
      Expect.Numbers(Session.Numbers(wanted.CameraFromMap), Session.Numbers(found.CameraFromMap), "pose");
    }
  }

  public static void WhatDoesNotFitIsRefused() {
    LocalizerFrame frame = Session.Frame(0);
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer())
    using (var features = new Features(Session.Config())) {
      Expect.Equal(Status.State, Expect.Throws<SpherecloudException>(
          () => features.Read(), "of no frame yet; call Localizer.Extract").Status, "status of none yet");
      Expect.Throws<SpherecloudException>(() => localizer.Locate(frame, features, out result), "");
      Expect.Throws<ArgumentException>(() => features.Set(frame, new FeatureArrays { Keypoints = new Keypoint[2] }), "descriptors");
      Expect.Throws<ArgumentException>(() => features.Set(frame, new FeatureArrays { Keypoints = null }), "null");
      var wild = new FeatureArrays { Keypoints = new Keypoint[1], Descriptors = new byte[128] };
      wild.Keypoints[0].XPx = float.NaN;
      Expect.Equal(Status.Argument, Expect.Throws<SpherecloudException>(() => features.Set(frame, wild), "").Status, "status of NaN");
      Expect.Equal(Status.MapExtractor, Expect.Throws<SpherecloudException>(
          () => features.Set(frame, new FeatureArrays { Extractor = 12345 }), "").Status, "status of another extractor");
      Expect.Throws<ArgumentNullException>(() => localizer.Extract(frame, null), "features");
      localizer.Extract(frame, features);
      frame.ColorTimeNs += 1;
      Expect.Throws<SpherecloudException>(() => localizer.Locate(frame, features, out result), "");
    }
  }
}
