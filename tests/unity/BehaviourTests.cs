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

    private static bool AreEqual(ReadOnlySpan<uint> chain, Cascade cascade, Texture2DArray texture, int slice)
    {
        for (var level = 0; level < cascade.Levels; ++level)
        {
            var side = cascade.Resolution >> level;
            if (!MemoryMarshal.AsBytes(chain.Slice(cascade.LevelOffset(level), side * side)).SequenceEqual(texture.Levels[(level, slice)])) return false;
        }
        return texture.Levels.Count(entry => entry.Key.Item2 == slice) == cascade.Levels;
    }

    [Test]
    public static void ABehaviourUploadsTheFrameThatItScheduledBefore()
    {
        var behaviour = new OceanBehaviour { Preset = "storm", Resolution = 32 };
        UnityEngine.Time.timeAsDouble = 2;
        UnityEngine.Object.Destroyed.Clear();
        Send(behaviour, "OnEnable");
        for (var update = 1; update <= 3; ++update)
        {
            UnityEngine.Time.timeAsDouble = 2 + update / 72.0;
            Send(behaviour, "Update");
            Check.Equal(behaviour.Frame.TimeS, 2 + (update - 1) / 72.0, "time of the frame");
            for (var i = 0; i < 4; ++i)
            {
                var cascade = behaviour.Frame.Cascade(i);
                Check.True(MemoryMarshal.AsBytes(cascade.DisplacementRgba16f).SequenceEqual(behaviour.Displacement.Levels[(0, i)]), "displacement");
                Check.True(AreEqual(cascade.SlopesRgba8, cascade, behaviour.Slopes, i), "slopes");
                Check.True(AreEqual(cascade.MomentsRgba8, cascade, behaviour.Moments, i), "moments");
                for (var image = 0; i < 3 && image < 2; ++image)
                    Check.True(AreEqual(cascade.SnapshotsRgba8(image), cascade, behaviour.Snapshots, 3 * image + i), "snapshots");
            }
            // Frames of 1/72 s: the snapshots do not change in each.
            Check.True(behaviour.Snapshots.Applied >= 1 && behaviour.Snapshots.Applied <= 2, "uploads of snapshots");
            foreach (var texture in new[] { behaviour.Displacement, behaviour.Slopes, behaviour.Moments })
            {
                Check.Equal(texture.Applied, update, "calls of Apply(false)");
                Check.True(texture.IsLinear && texture.Depth == 4 && texture.Side == 32, "an array of 4 linear textures");
            }
        }
        Check.True(Shader.Globals["_PelagicSlopes"] == (object)behaviour.Slopes, "shaders find the textures");
        Check.Equal(((Vector4[])Shader.Globals["_PelagicCascades"])[1].x, (float)behaviour.Frame.Cascade(1).SideM, "and the cascades");
        Check.Equal(behaviour.HeightAt(new Vector3 { x = 3, z = 4 }), behaviour.Ocean.HeightAt(3, -4), "z is mirrored");

        Ocean ocean = behaviour.Ocean;
        Send(behaviour, "OnDisable");
        Check.Throws<ObjectDisposedException>(() => ocean.Schedule(0), "the ocean of a disabled component");
        Check.Equal(UnityEngine.Object.Destroyed.Count, 4, "destroyed textures");
        Send(behaviour, "OnEnable");
        Send(behaviour, "Update");
        Send(behaviour, "OnDisable");
    }
}
