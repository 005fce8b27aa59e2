using System;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using Pelagic;

public static class LayoutTests
{
    private static readonly Assembly assembly = typeof(Ocean).Assembly;

    private static string Pascal(string name)
    {
        return string.Concat(name.Split('_').Where(part => part != "").Select(part => char.ToUpperInvariant(part[0]) + part.Substring(1).ToLowerInvariant()));
    }

    private static Type TypeOf(string name)
    {
        return assembly.GetType("Pelagic.Native+" + name) ?? assembly.GetType("Pelagic." + Pascal(name.Substring("pelagic_".Length)));
    }

    /// <summary>A field of C, or the first of those that stand for its elements.</summary>
    private static string FieldOf(Type type, string name)
    {
        var names = type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic).Select(field => field.Name).ToArray();
        var unit = Math.Max(name.LastIndexOf('_'), 0);
        var vector = Pascal(name.Substring(0, unit)) + "X" + Pascal(name.Substring(unit));
        return new[] { name, Pascal(name), name + "_0", Pascal(name) + "X", vector }.FirstOrDefault(names.Contains)
            ?? throw new Exception($"{type.Name} has no {name}");
    }

    [Test]
    public static void StructsHaveTheSizesAndOffsetsOfC()
    {
        var compared = 0;
        foreach (var name in Expected.Names("layout pelagic_"))
        {
            var parts = name.Substring("layout ".Length).Split('.');
            var type = TypeOf(parts[0]);
            Check.True(type != null, $"no struct {parts[0]}");
            var number = parts.Length == 1 ? Marshal.SizeOf(type) : (long)Marshal.OffsetOf(type, FieldOf(type, parts[1]));
            Check.Equal(number, Expected.Number(name), name);
            ++compared;
        }
        Check.True(compared > 300, "all fields are compared");
    }

    private static object Make(string name)
    {
        var native = assembly.GetType("Pelagic.Native");
        return native.GetMethod(name + "_make", BindingFlags.Static | BindingFlags.NonPublic)?.Invoke(null, null) ?? Activator.CreateInstance(TypeOf(name));
    }

    [Test]
    public static void StructsHaveTheDefaultsOfC()
    {
        var compared = 0;
        foreach (var name in Expected.Names("default pelagic_"))
        {
            var parts = name.Substring("default ".Length).Split('.');
            var made = Make(parts[0]);
            var type = made.GetType();
            var field = type.GetField(FieldOf(type, parts[1]), BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic);
            var value = field.GetValue(made);
            var number = value is UIntPtr size ? (double)(ulong)size : value is Enum ? (int)value : Convert.ToDouble(value);
            Check.Equal(number, Expected.Real(name), name);
            ++compared;
        }
        Check.True(compared > 90, "all fields are compared");
    }

    [Test]
    public static void StructsAreBlittable()
    {
        foreach (var name in Expected.Names("layout pelagic_").Where(name => !name.Contains(".")))
        {
            var type = TypeOf(name.Substring("layout ".Length));
            // The garbage collector pins blittable objects only.
            GCHandle.Alloc(Activator.CreateInstance(type), GCHandleType.Pinned).Free();
            Check.True(true, type.Name);
        }
    }
}
