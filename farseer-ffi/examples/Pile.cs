// The scene of pile.c in C#, without MonoGame. It prints the same bits.
//
//     cargo build --release -p farseer-ffi
//     mcs -out:Pile.exe farseer-ffi/examples/Pile.cs farseer-ffi/csharp/Farseer.cs
//     LD_LIBRARY_PATH=target/release mono Pile.exe
using System;
using FarseerFfi;

static class Pile
{
    static Simulator simulator;

    static void Check(Status status) { Simulator.Check(status); }

    static Vector2 At(float x, float y) { return new Vector2(x, y); }

    static ulong AddBox(float width, float height, Vector2 position)
    {
        ulong body, geom;
        var placement = new Placement();
        Check(Native.farseer_body_create_rectangle(simulator.Handle, width, height, 1.0f, out body));
        Check(Native.farseer_body_set_position(simulator.Handle, body, position));
        Check(Native.farseer_geom_create_rectangle(simulator.Handle, body, width, height, ref placement, out geom));
        Check(Native.farseer_geom_set_friction_coefficient(simulator.Handle, geom, 0.5f));
        return body;
    }

    static ulong AddBall(float radius, Vector2 position)
    {
        ulong body, geom;
        var placement = new Placement();
        Check(Native.farseer_body_create_circle(simulator.Handle, radius, 2.0f, out body));
        Check(Native.farseer_body_set_position(simulator.Handle, body, position));
        Check(Native.farseer_geom_create_circle(simulator.Handle, body, radius, 16, ref placement, out geom));
        Check(Native.farseer_geom_set_restitution_coefficient(simulator.Handle, geom, 0.5f));
        return body;
    }

    static void AddWedge()
    {
        BodyOptions body;
        GeomOptions geom;
        Check(Native.farseer_body_options_default(out body));
        Check(Native.farseer_geom_options_default(out geom));
        body.Position = At(60.0f, -100.0f);
        geom.Shape = Shape.Polygon;
        simulator.AddBody(body, geom, new[] { At(-15.0f, 10.0f), At(15.0f, 10.0f), At(0.0f, -15.0f) });
    }

    static void AddPendulum()
    {
        ulong joint;
        ulong upper = AddBox(10.0f, 40.0f, At(-150.0f, 60.0f));
        ulong lower = AddBox(10.0f, 40.0f, At(-150.0f, 100.0f));
        Check(Native.farseer_joint_create_fixed_revolute(simulator.Handle, upper, At(-150.0f, 40.0f), out joint));
        Check(Native.farseer_joint_create_revolute(simulator.Handle, upper, lower, At(-150.0f, 80.0f), out joint));
        Check(Native.farseer_body_apply_impulse(simulator.Handle, lower, At(80.0f, 0.0f)));
    }

    static void AddSpring()
    {
        ulong spring;
        ulong ball = AddBall(8.0f, At(150.0f, 0.0f));
        Check(Native.farseer_spring_create_fixed_linear(
            simulator.Handle, ball, At(0.0f, 0.0f), At(150.0f, -50.0f), 20.0f, 0.5f, out spring));
    }

    static void AddScene()
    {
        ulong floor = AddBox(400.0f, 20.0f, At(0.0f, 200.0f));
        Check(Native.farseer_body_set_is_static(simulator.Handle, floor, 1));
        for (int i = 0; i < 10; i++)
        {
            AddBox(20.0f, 20.0f, At(-40.0f + 25.0f * (i % 4) + i, 150.0f - 30.0f * i));
        }
        ulong ball = AddBall(12.0f, At(5.0f, -200.0f));
        Check(Native.farseer_body_set_linear_velocity(simulator.Handle, ball, At(10.0f, 0.0f)));
        AddWedge();
        AddPendulum();
        AddSpring();
    }

    static void Run(int updates)
    {
        for (int i = 0; i < updates; i++)
        {
            simulator.Update(1.0f / 60.0f);
        }
    }

    static string Bits(float value)
    {
        return BitConverter.ToUInt32(BitConverter.GetBytes(value), 0).ToString("x8");
    }

    static void PrintBodies()
    {
        ulong[] bodies = simulator.Bodies();
        var positions = new Vector2[bodies.Length];
        var rotations = new float[bodies.Length];
        Check(Native.farseer_bodies_read(
            simulator.Handle, bodies, (UIntPtr)bodies.Length, positions, rotations, null, null));
        for (int i = 0; i < bodies.Length; i++)
        {
            Console.WriteLine("{0} {1} {2}", Bits(positions[i].X), Bits(positions[i].Y), Bits(rotations[i]));
        }
    }

    static void Play(string name, Methods methods)
    {
        using (simulator = new Simulator(methods, At(0.0f, 300.0f)))
        {
            AddScene();
            Console.WriteLine(name);
            Run(200);
            byte[] snapshot = simulator.Snapshot();
            Run(100);
            Console.WriteLine("hash {0:x16}", simulator.StateHash);
            simulator.Restore(snapshot);
            Run(100);
            Console.WriteLine("hash {0:x16}", simulator.StateHash);
            Console.WriteLine("events {0}", simulator.Events().Length);
            PrintBodies();
        }
    }

    static void Main()
    {
        Play("faithful", Methods.Faithful);
        Play("precise", Methods.Precise);
        try
        {
            new Simulator(Methods.Precise, At(float.NaN, 0.0f));
            throw new Exception("NaN was accepted");
        }
        catch (FarseerException refusal)
        {
            Console.Error.WriteLine("refused, as it should be: {0}", refusal.Message);
        }
    }
}
