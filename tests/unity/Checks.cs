using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Reflection;

/// <summary>Marks a test: a static method without parameters that throws if its claim is wrong.</summary>
[AttributeUsage(AttributeTargets.Method)]
public sealed class TestAttribute : Attribute
{
    /// <summary>True: runs only if it is named, in a process of its own.</summary>
    public bool IsAlone;
}

public static class Check
{
    public static int Count;

    public static void True(bool isTrue, string claim)
    {
        ++Count;
        if (!isTrue) throw new Exception(claim);
    }

    public static void Equal<T>(T found, T expected, string what)
    {
        True(EqualityComparer<T>.Default.Equals(found, expected), $"{what} is {found}, not {expected}");
    }

    public static E Throws<E>(Action action, string what) where E : Exception
    {
        ++Count;
        try
        {
            action();
        }
        catch (E exception)
        {
            return exception;
        }
        throw new Exception($"{what}: no {typeof(E).Name}");
    }
}

/// <summary>Values that the test's driver wrote: golden hashes and values, and the layout of C.</summary>
public static class Expected
{
    /// <summary>The bits of floats, doubles and hashes, as rows of tests/golden/values.txt have them.</summary>
    public static string Bits(params object[] numbers)
    {
        return string.Join(",", numbers.Select(number => number is float ? BitConverter.ToUInt32(BitConverter.GetBytes((float)number), 0).ToString("x8")
            : number is double ? BitConverter.DoubleToInt64Bits((double)number).ToString("x16") : ((ulong)number).ToString("x16")));
    }

    private static readonly Dictionary<string, string> values = new Dictionary<string, string>();

    public static void Read(string file)
    {
        foreach (var line in File.ReadLines(file)) values[line.Substring(0, line.LastIndexOf(' '))] = line.Substring(line.LastIndexOf(' ') + 1);
    }

    public static IEnumerable<string> Names(string prefix) => values.Keys.Where(name => name.StartsWith(prefix));
    public static string Text(string name) => values[name];
    public static ulong Hash(string name) => Convert.ToUInt64(values[name], 16);
    public static long Number(string name) => long.Parse(values[name]);
    public static double Real(string name) => double.Parse(values[name], CultureInfo.InvariantCulture);
}

public static class Program
{
    /// <summary>usage: EXPECTED_VALUES [NAME...]</summary>
    public static int Main(string[] arguments)
    {
        Expected.Read(arguments[0]);
        var tests = typeof(Program).Assembly.GetTypes().SelectMany(type => type.GetMethods(BindingFlags.Static | BindingFlags.Public))
            .Where(method => method.GetCustomAttribute<TestAttribute>() != null);
        int passed = 0, failed = 0;
        foreach (var test in tests)
        {
            var name = $"{test.DeclaringType.Name}.{test.Name}";
            if (arguments.Length > 1 ? !arguments.Skip(1).Contains(name) : test.GetCustomAttribute<TestAttribute>().IsAlone) continue;
            try
            {
                test.Invoke(null, null);
                ++passed;
            }
            catch (TargetInvocationException exception)
            {
                Console.WriteLine($"{name}: {exception.InnerException}");
                ++failed;
            }
        }
        Console.WriteLine($"{Check.Count} checks");
        Console.WriteLine($"{passed} passed, {failed} failed");
        return failed == 0 && passed > 0 ? 0 : 1;
    }
}
