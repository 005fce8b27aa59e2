using System;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using Pelagic;
using Pelagic.Unity;
using UnityEngine;

public static class BehaviourTests
{
    public static void Send(MonoBehaviour behaviour, string message)
    {
        try
        {
            behaviour.GetType().GetMethod(message, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(behaviour, null);
        }
        catch (TargetInvocationException exception)
        {
            throw exception.InnerException;
        }
    }

    /// <summary>Sends Update() at successive times until a condition holds. Returns the number of updates.</summary>
    public static int UpdateUntil(OceanBehaviour behaviour, Func<bool> isReached, string what)
    {
        for (var updates = 1; updates <= 1000; ++updates)
        {
            UnityEngine.Time.timeAsDouble += 1 / 72.0;
            Send(behaviour, "Update");
            if (isReached()) return updates;
            System.Threading.Thread.Sleep(1);
        }
        throw new Exception($"{what}: not in 1,000 updates");
    }

    private static bool AreEqual(ReadOnlySpan<uint> chain, Cascade cascade, Texture2DArray texture, int slice)
    {
        for (var level = 0; level < cascade.Levels; ++level)
        {
            var side = cascade.Resolution >> level;
            if (!MemoryMarshal.AsBytes(chain.Slice(cascade.LevelOffset(level), side * side)).SequenceEqual(texture.Sent(level, slice))) return false;
        }
        return texture.mipmapCount == cascade.Levels;
    }

    /// <summary>Compares with an ocean whose textures are in its own memory; with aligned and other memory of textures.</summary>
    [Test]
    public static void ShadersSeeTheFrameThatWasScheduledBefore()
    {
        foreach (var misalignment in new[] { 0, 16 })
            try
            {
                Texture2DArray.Misalignment = misalignment;
                var behaviour = new OceanBehaviour { Preset = "storm", Resolution = 32 };
                UnityEngine.Time.timeAsDouble = 2;
                UnityEngine.Object.Destroyed.Clear();
                Send(behaviour, "OnEnable");
                var sea = Sea.Preset("storm");
                sea.Resolution = 32;
                Texture2DArray before = null;
                using (var plain = new Ocean(sea, new OceanOptions { Foam = true, Slopes = Pelagic.Textures.On }))
                    for (var update = 1; update <= 4; ++update)
                    {
                        UnityEngine.Time.timeAsDouble = 2 + update / 72.0;
                        Texture2DArray.Copied = 0;
                        Send(behaviour, "Update");
                        Check.Equal(behaviour.Frame.TimeS, 2 + (update - 1) / 72.0, "time of the frame");
                        var frame = GoldenTests.FrameAt(plain, behaviour.Frame.TimeS);
                        var copied = misalignment == 0 ? 0L : 4 * 8 * 32 * 32;
                        // Snapshots change in the first frame, and at most once in three frames of 1/72 s.
                        Check.True(Texture2DArray.Copied - copied == 0 || Texture2DArray.Copied - copied <= 6 * 4 * (4 * 32 * 32 - 1) / 3, "bytes that were copied");
                        for (var i = 0; i < 4; ++i)
                        {
                            var cascade = frame.Cascade(i);
                            Check.True(MemoryMarshal.AsBytes(cascade.DisplacementRgba16f).SequenceEqual(behaviour.Displacement.Sent(0, i)), "displacement");
                            Check.True(AreEqual(cascade.SlopesRgba8, cascade, behaviour.Slopes, i), "slopes");
                            Check.True(AreEqual(cascade.MomentsRgba8, cascade, behaviour.Moments, i), "moments");
                            for (var image = 0; i < 3 && image < 2; ++image)
                                Check.True(AreEqual(cascade.SnapshotsRgba8(image), cascade, behaviour.Snapshots, 3 * image + i), "snapshots");
                        }
                        Check.True(behaviour.Snapshots.Applied >= 1 && behaviour.Snapshots.Applied <= 2, "uploads of snapshots");
                        foreach (var texture in new[] { behaviour.Displacement, behaviour.Slopes, behaviour.Moments })
                        {
                            Check.Equal(texture.Applied, (update + 1) / 2, "every other frame is sent");
                            Check.True(texture.IsLinear && texture.Depth == 4 && texture.Side == 32, "an array of 4 linear textures");
                        }
                        Check.True(behaviour.Displacement != before, "textures alternate");
                        before = behaviour.Displacement;
                        Check.True(Shader.Globals["_PelagicSlopes"] == (object)behaviour.Slopes, "shaders find the textures");
                    }
                Check.Equal(((Vector4[])Shader.Globals["_PelagicCascades"])[1].x, (float)behaviour.Frame.Cascade(1).SideM, "and the cascades");
                Check.Equal(behaviour.HeightAt(new Vector3 { x = 3, z = 4 }), behaviour.Ocean.HeightAt(3, -4), "z is mirrored");

                Ocean ocean = behaviour.Ocean;
                Send(behaviour, "OnDisable");
                Check.Throws<ObjectDisposedException>(() => ocean.Schedule(0), "the ocean of a disabled component");
                Check.Equal(UnityEngine.Object.Destroyed.Count, 7, "destroyed textures");
            }
            finally
            {
                Texture2DArray.Misalignment = 0;
            }
    }
}
