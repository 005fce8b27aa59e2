// Registration of C++ classes as classes of the engine: properties with setters and getters, methods, virtual methods.
#pragma once

#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/contrib/godot4/engine.hpp"
#include "pelagic/contrib/godot4/option.hpp"

namespace pelagic::godot4 {

/// An object of the library, behind an object of the engine. Virtual methods are those of the engine. NodeClass reports
/// what they throw.
class Node {
   public:
    explicit Node(Object* self, const char* class_name) : self_(self), class_name_(class_name) {}
    virtual ~Node() = default;
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    virtual void enter_tree() {}
    virtual void exit_tree() {}
    virtual void process(double) {}
    virtual void physics_process(double) {}

    Value self() const { return Value::object(self_); }
    /// Reports an invalid value: prints a line and emits the signal `refused` with it.
    void reject(std::string_view line) const;

   protected:
    /// Runs `work` in each frame: throws the reason for which it fails once, until it succeeds.
    template <class Work>
    void run_in_frame(const Work& work) {
        try {
            work();
            reported_.clear();
        } catch (const std::exception& error) {
            if (reported_ == error.what()) return;
            reported_ = error.what();
            throw;
        }
    }

    Object* self_;
    const char* class_name_;

   private:
    std::string reported_;
};

struct Argument {
    const char* name;
    Type type;
};
struct Method {
    std::string name;
    std::vector<Argument> arguments;
    Type result;               ///< nil: none
    std::string result_class;  ///< of an object
    std::function<Value(Node&, std::span<const Value>)> call;
};
struct Property {
    std::string name;
    Type type;
    std::uint32_t hint;  ///< PropertyHint
    std::string hint_text, class_name;
};

/// A class. Its addresses are those of the engine's user data until it is unregistered.
class NodeClass {
   public:
    using Make = std::function<std::unique_ptr<Node>(Object*)>;
    NodeClass(const char* name, const char* parent, std::vector<std::string> virtuals, Make make)
        : name_(name), parent_(parent), virtuals_(std::move(virtuals)), make_(std::move(make)) {}

    void method(std::string name, std::vector<Argument> arguments, Type result,
                std::function<Value(Node&, std::span<const Value>)> call) {
        methods_.push_back({std::move(name), std::move(arguments), result, {}, std::move(call)});
    }
    void property(Property property, const std::function<Value(Node&)>& get,
                  const std::function<void(Node&, const Value&)>& set);
    /// A property that a table describes, in a struct of the node.
    void option(const std::string& prefix, const Option& option, const std::function<const void*(const Node&)>& read,
                const std::function<void(Node&, const Option&, double)>& write);

    void register_class();
    void unregister_class();

   private:
    static GDExtensionObjectPtr create(void* data);
    static void call(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstVariantPtr* arguments,
                     GDExtensionInt count, GDExtensionVariantPtr result, GDExtensionCallError* error);
    static void ptrcall(void* data, GDExtensionClassInstancePtr instance, const GDExtensionConstTypePtr* arguments,
                        GDExtensionTypePtr result);
    static GDExtensionClassCallVirtual virtual_of(void* data, GDExtensionConstStringNamePtr name);

    const char *name_, *parent_;
    std::vector<std::string> virtuals_;
    Make make_;
    std::deque<Method> methods_;
    std::deque<Property> properties_;
};

/// Throws std::invalid_argument "NAME VALUE is out of range ACCEPTED".
[[noreturn]] void refuse(std::string_view name, const std::string& value, std::string_view accepted);
/// Returns the value of an option as the text or the number of a script. Throws std::invalid_argument.
double value_of(const Option& option, std::string_view name, const Value& value);
/// Sets the fields that a Dictionary has. Throws std::invalid_argument for unknown keys and values out of range.
void read_dictionary(std::span<const Option> table, void* options, const Value& dictionary, std::string_view kind);

}  // namespace pelagic::godot4
