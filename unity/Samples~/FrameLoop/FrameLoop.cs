using System;
using Pelagic;

/// <summary>The frame loop of a game without rendering.</summary>
public static class FrameLoop
{
    /// <summary>Computes five frames, and passes a line about each to `print`.</summary>
    public static void Run(Action<string> print)
    {
        var sea = Sea.Default;
        sea.WindSpeedMps = 9;
        double[] x = { 10, 20, 30 }, z = { 5, 5, 5 };
        var heights = new float[3];
        using (var ocean = new Ocean(sea, new OceanOptions { Queries = true }))
        {
            ocean.Schedule(0);
            for (var n = 1; n <= 5; ++n)
            {
                Frame frame = ocean.Complete();  // scheduled one frame ago
                ocean.Schedule(n / 90.0);        // computed while this frame is drawn
                ocean.Query(x, z, new Samples { HeightM = heights });
                for (var i = 0; i < frame.CascadeCount; ++i) Upload(frame.Cascade(i));
                print($"{frame.TimeS:0.0000} s: hash {ocean.Hash():x16}, buoys at {heights[0]:0.000} {heights[1]:0.000} {heights[2]:0.000} m");
            }
        }
    }

    /// <summary>A renderer uploads these textures, and all their levels.</summary>
    private static void Upload(Cascade cascade)
    {
        ReadOnlySpan<ushort> displacement = cascade.DisplacementRgba16f;
        ReadOnlySpan<uint> slopes = cascade.SlopesRgba8, moments = cascade.MomentsRgba8;
        if (displacement.IsEmpty || slopes.IsEmpty || moments.IsEmpty) throw new InvalidOperationException("No textures.");
    }
}
