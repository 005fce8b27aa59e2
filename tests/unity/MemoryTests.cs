using System;
using System.Runtime.InteropServices;
using Pelagic;

public static class MemoryTests
{
    private static CascadeArrays[] ArraysOf(Ocean ocean)
    {
        var texels = ocean.Info.Resolution * ocean.Info.Resolution;
        var arrays = new CascadeArrays[ocean.Info.CascadeCount];
        for (var i = 0; i < arrays.Length; ++i)
            arrays[i] = new CascadeArrays { Height = new float[texels], DisplacementRgba16f = new ushort[4 * texels], SlopesRgba8 = new uint[(4 * texels - 1) / 3], MomentsRgba8 = new uint[(4 * texels - 1) / 3] };
        return arrays;
    }

    private static void Compare(Frame frame, CascadeArrays[] arrays)
    {
        for (var c = 0; c < arrays.Length; ++c)
        {
            var cascade = frame.Cascade(c);
            for (var j = 0; j < frame.Resolution; j += 7)
                for (var i = 0; i < frame.Resolution; ++i) Check.Equal(arrays[c].Height[j * frame.Resolution + i], cascade.Height[i, j], "height");
            Check.True(cascade.DisplacementRgba16f.SequenceEqual(arrays[c].DisplacementRgba16f), "displacement");
            Check.True(cascade.SlopesRgba8.SequenceEqual(arrays[c].SlopesRgba8), "slopes");
            Check.True(cascade.MomentsRgba8.SequenceEqual(arrays[c].MomentsRgba8), "moments");
        }
    }

    [Test]
    public static void CopiesAndSynchronousFramesEqualViews()
    {
        using (var ocean = new Ocean(Sea.Default))
        {
            CascadeArrays[] early = ArraysOf(ocean), copies = ArraysOf(ocean);
            var bounds = ocean.FrameAt(12.34, early);
            var frame = GoldenTests.FrameAt(ocean, 12.34);
            ocean.Copy(copies);
            Compare(frame, early);
            Compare(frame, copies);
            Check.Equal(bounds.HeightMaxM, frame.Bounds.HeightMaxM, "bounds");
            ocean.FrameAt(1, early);
            Compare(frame, copies);
            Check.Throws<PelagicException>(() => ocean.FrameAt(1, early[0]), "one of four");
            early[1].Height = new float[3];
            Check.Throws<PelagicException>(() => ocean.Copy(early), "a short array");
            early[1].Dx = new float[4];
            Check.Throws<ArgumentException>(() => ocean.Copy(early), "arrays that differ");
        }
    }

    [Test]
    public static void TexturesInMemoryOfTheApplicationEqualThoseOfTheFrame()
    {
        var sea = Sea.Default;
        sea.Resolution = 32;
        var memory = Marshal.AllocHGlobal(4 * 8 * 32 * 32 + 64);
        try
        {
            using (var into = new Ocean(sea))
            using (var plain = new Ocean(sea))
            {
                var targets = new TextureTargets[4];
                var bytes = new byte[8 * 32 * 32];
                for (var i = 0; i < 4; ++i) targets[i].DisplacementRgba16f = new IntPtr((memory.ToInt64() + 63) / 64 * 64 + i * bytes.Length);
                var expected = GoldenTests.FrameAt(plain, 3);
                into.ScheduleInto(3, targets);
                var frame = into.Complete();
                for (var i = 0; i < 4; ++i)
                {
                    Marshal.Copy(targets[i].DisplacementRgba16f, bytes, 0, bytes.Length);
                    Check.True(MemoryMarshal.Cast<byte, ushort>(bytes).SequenceEqual(expected.Cascade(i).DisplacementRgba16f), "displacement");
                    Check.True(frame.Cascade(i).DisplacementRgba16f.IsEmpty, "the texture is not in the frame");
                    Check.True(frame.Cascade(i).SlopesRgba8.SequenceEqual(expected.Cascade(i).SlopesRgba8), "slopes stay in the frame");
                }
                Check.Throws<PelagicException>(() => into.ScheduleInto(4, new TextureTargets[1]), "too few targets");
            }
        }
        finally
        {
            Marshal.FreeHGlobal(memory);
        }
    }

    [Test]
    public static void FramesOfTexturesOnlyHaveTheTexturesOfOtherFrames()
    {
        using (var textures = new Ocean(Sea.Default, new OceanOptions { TexturesOnly = true }))
        using (var all = new Ocean(Sea.Default))
        {
            Frame frame = GoldenTests.FrameAt(textures, 12.34), expected = GoldenTests.FrameAt(all, 12.34);
            for (var i = 0; i < 4; ++i)
            {
                Cascade cascade = frame.Cascade(i), other = expected.Cascade(i);
                Check.True(cascade.Height.IsEmpty && cascade.Height.Data.IsEmpty && !other.Height.IsEmpty, "no planes");
                Check.Throws<InvalidOperationException>(() => cascade.Height[0, 0].ToString(), "a texel of no plane");
                Check.True(cascade.DisplacementRgba16f.SequenceEqual(other.DisplacementRgba16f), "displacement");
                Check.True(cascade.SlopesRgba8.SequenceEqual(other.SlopesRgba8), "slopes");
            }
        }
    }
}
